// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Sides of a specimen in space: nodes of prescribed velocity, and the force that holds them.
/// SI units.
#pragma once

#include <flexpm/kernel/assembly/solid_state.hpp>
#include <flexpm/kernel/space/solid.hpp>

#include <vector>

namespace flexpm {

/// Nodes of the grains on a side, without repetition, by their offsets.
std::vector<int> side_nodes(const SolidState& s, SolidSide side);

/// Give nodes a velocity along an axis (0: x) from now on [m/s].
void prescribe(SolidState& s, const std::vector<int>& nodes, int axis, double velocity);

/// Force along an axis that holds nodes against the grains [N].
double holding_force(const SolidState& s, const std::vector<int>& nodes, int axis);

}  // namespace flexpm
