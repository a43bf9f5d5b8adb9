// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Gravity on real masses: weights and potential energy. SI units. It makes no sense with
/// scaled masses (paper Sec. 2.4), whose weights would mean nothing.
#pragma once

#include <flexpm/kernel/assembly/bonded_state.hpp>

namespace flexpm {

/// Set the acceleration that acts on all masses [m/s^2]. What this changes in the potential energy
/// of grains that have moved counts as initial energy.
/// @throws std::invalid_argument  if a component is not finite
void set_gravity(BondedState& s, Vector acceleration);

/// Add the weights of a block's nodes (of rigid grains: at the centres) to the forces.
void add_weight(BondedState& s, int block);

/// Potential energy in the field of gravity, 0 at the reference [J].
double potential_energy(const BondedState& s);

}  // namespace flexpm
