// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Sections through a specimen in space, and how far they move: gauge.hpp there. SI units.
#pragma once

#include <flexpm/kernel/solids/solid_state.hpp>

#include <vector>

namespace flexpm {

/// A section through a specimen: the nodes in a band, and where they lie.
struct SolidSection {
    std::vector<int> nodes;
    double place = 0.0;  ///< mean of the bonded nodes along the direction [m]
};

/// Nodes of grains, bonded, that are no further than half a width from a place along a unit vector.
/// @throws std::invalid_argument  if there are none
SolidSection section_at(const SolidState& s, double place, Vector direction, double half_width);

/// Mean way of nodes along a unit vector [m].
/// @throws std::invalid_argument  if there are none, or one of them is no node of the specimen
double mean_way(const SolidState& s, const std::vector<int>& nodes, Vector direction);

}  // namespace flexpm
