// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Forces of pairs of grains that have no face in common: pressure by the energy of their
/// overlap, geometry/overlap.hpp, and friction by pair_friction.hpp. SI units.
#pragma once

#include <flexpm/kernel/assembly/solid_state.hpp>

#include <vector>

namespace flexpm {

/// Move the bodies of a thread's share of the grains in pairs to where these are now.
void follow_bodies(SolidState& s, int thread, int threads);

/// Update a thread's share of the pairs: what they bear, and their loads on both grains. Bodies must
/// be those of now.
///
/// @param dt  since the last forces, with the present velocities [s]; 0: friction stays
void update_pairs(SolidState& s, double dt, int thread, int threads);

/// Both of all pairs, one after the other.
void update_pairs(SolidState& s, double dt);

/// Add the forces of pairs on the nodes of both grains to forces on all nodes [N]. They are derived
/// from the saved state, so that a loaded one has the same bits; nothing that a step reads changes.
void add_loads_of_pairs(const SolidState& s, double* forces);

/// Add the loads of pairs to the nodes of a block of grains, or to the wrench of a rigid grain, in the
/// order of pairs.
void add_pair_forces(SolidState& s, int block);

/// Largest stiffness of each corner of a face against a pressure in one place, where others follow:
/// the product of its share in a force and of the sum of all shares, at the worst corner [-].
std::vector<double> largest_shares(const std::vector<Vector>& corners);

}  // namespace flexpm
