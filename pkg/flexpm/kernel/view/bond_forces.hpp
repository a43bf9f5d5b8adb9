// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Forces of contacts as a window shows them, in 2D and in 3D. `State` is Assembly or
/// SolidState. SI units.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>
#include <flexpm/kernel/assembly/solid_state.hpp>

#include <array>

namespace flexpm {

/// Line between the centres of two grains, where displacements are drawn `factor` times larger [m].
std::array<Vector, 2> branch_line(const Grains& grains, GrainPair pair, double factor);

/// Force of a contact along its normal [N], tension positive; 0 if its face has no area.
template <class State> double normal_force(const State& s, int contact);

/// Largest force of all contacts that are there [N].
template <class State> double largest_contact_force(const State& s);

}  // namespace flexpm
