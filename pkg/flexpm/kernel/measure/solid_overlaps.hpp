// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Grains of a solid that lie on each other at the end of a test. SI units.
#pragma once

#include <flexpm/kernel/assembly/solid_state.hpp>

namespace flexpm {

/// Two grains that were never neighbours, which nothing keeps apart, and lie on each other.
struct SolidOverlap {
    double depth = 0.0;  ///< [m]; 0: there is none
    GrainPair pair { -1, -1 };
    double of_diameter = 0.0;  ///< depth over the mean diameter [-]
    int pairs = 0;             ///< that overlap
};

/// The deepest overlap of grains that do not share a contact. The depth of a pair is how far the
/// corners of one lie within the other, which is taken as convex.
SolidOverlap largest_overlap(const SolidState& s);

}  // namespace flexpm
