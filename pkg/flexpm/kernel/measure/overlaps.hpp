// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Grains that lie on each other, which contacts at edges and discs do not all prevent. SI
/// units.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

#include <vector>

namespace flexpm {

/// Two grains whose polygons overlap.
struct Overlap {
    GrainPair pair;
    double area;  ///< that both cover [m^2]
    double part;  ///< of the smaller grain [-]
    bool bonded;  ///< the two were bonded once, not on a joint
    bool facing;  ///< bonded, and the faces of such a bond lie as they did, is_facing()
    /// Area that the pair's normal force accounts for: over stiffness and thickness [m^2].
    double closed;
};

/// Pairs of grains that overlap by more than a part of the smaller one, ascending. Corners are
/// taken as convex.
std::vector<Overlap> find_overlaps(const Assembly& a, double smallest_part);

}  // namespace flexpm
