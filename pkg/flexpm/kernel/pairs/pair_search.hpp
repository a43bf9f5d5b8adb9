// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Pairs of grains that come and go: faces of contacts that have ended, grains that come near
/// each other. SI units.
///
/// A contact ends when all its points are cracked and its faces lie on each other no more. The pair
/// then takes over with the clearance at which it stores the energy of the contact, so that no
/// energy appears. A pair that is found overlapping otherwise has that overlap as its clearance:
/// it begins without energy and without force.
#pragma once

#include <flexpm/kernel/assembly/solid_state.hpp>

namespace flexpm {

/// Whether the faces of a contact, all of whose points are cracked, lie on each other no more: the
/// grains have slid along the face, or have opened without a point that presses, by more than 0.02
/// of the square root of its area, or have turned by 2 degrees against each other.
bool has_parted(const SolidState& s, int contact);

/// End the contacts whose faces have parted, search near pairs, and let clearances fall with the
/// overlap of pairs that do not press. To be called between steps: after some number of them, and
/// where has_to_search() says so. A saved state goes on to the same bits if it was saved with the
/// number of its steps.
///
/// @return  whether there are pairs
bool look_for_pairs(SolidState& s);

/// Note the motion of a step, and return whether grains may have moved so far that others are near
/// them now.
/// @param dt  of the step [s]
bool has_to_search(SolidState& s, double dt);

/// Derive what a step needs of the pairs, after loading.
void prepare_pairs(SolidState& s);

}  // namespace flexpm
