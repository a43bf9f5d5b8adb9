// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Mean stress of a solid, and the one that what acts on it from outside would give it in
/// balance: mean_stress.hpp for the plane. SI units, tension positive.
#pragma once

#include <flexpm/kernel/assembly/solid_state.hpp>

namespace flexpm {

/// How far a solid is in balance as a whole, at the last step; as Balance of the plane.
struct SolidBalance {
    SpaceTensor mean_stress {};     ///< of the grains and what their contacts bear [Pa]
    SpaceTensor outside_stress {};  ///< of pressures, plates and held nodes [Pa]
    Vector missing_force;           ///< sum of the net forces on nodes that are free to move [N]
    double plate_share = 0.0;  ///< largest part of its load that a loaded plate does not bear [-]
};

SolidBalance balance(const SolidState& s);

}  // namespace flexpm
