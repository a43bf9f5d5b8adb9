// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Forces on nodes that come from none of the assembly: what grains that are taken away have
/// exerted on the wall that they leave. SI units.
/// Deviation D77.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

#include <vector>

namespace flexpm {

/// Forces on nodes, all of them times one part.
struct OuterForces {
    std::vector<int> nodes;     ///< their offsets, ascending
    std::vector<Point> forces;  ///< [N]
    double part = 0.0;          ///< that acts at the end of the coming step [-]
    double before = 0.0;        ///< that acts at its beginning [-]
};

/// Forces of some grains on all others, by their contacts, after the last step.
///
/// @param inside  for each grain 1 if it is one of them
OuterForces forces_on_wall(const Assembly& a, const std::vector<char>& inside);

/// @throws std::invalid_argument  unless each node is one that the assembly has, in ascending
///         order, and each has its force
void check(const Assembly& a, const OuterForces& outer);

/// Add them to the forces on the nodes of a block of grains.
void add_outer_forces(Assembly& a, int block, const OuterForces& outer);

/// Their work over the coming step [J].
double work_of(const Assembly& a, const OuterForces& outer, double dt);

}  // namespace flexpm
