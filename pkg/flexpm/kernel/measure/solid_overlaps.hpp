// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Grains of a solid that lie on each other at the end of a test. SI units.
#pragma once

#include <flexpm/kernel/assembly/solid_state.hpp>

namespace flexpm {

/// Two grains that overlap and have no common face.
struct SolidOverlap {
    double depth = 0.0;  ///< [m]; 0: there is none
    GrainPair pair { -1, -1 };
    double of_diameter = 0.0;  ///< depth over the mean diameter [-]
    int pairs = 0;             ///< that overlap
    /// Largest part of the depth of a pair that no force resists, over the mean diameter [-].
    double clearance = 0.0;
};

/// The deepest overlap of grains whose faces do not lie on each other. The depth of a pair is how far the
/// corners of one lie within the other, which is taken as convex.
SolidOverlap largest_overlap(const SolidState& s);

}  // namespace flexpm
