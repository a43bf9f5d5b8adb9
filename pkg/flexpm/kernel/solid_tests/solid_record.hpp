// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  What a test of a solid leaves beside its curve: cracks, what holds together, grains that
/// lie on each other. SI units.
#pragma once

#include <flexpm/kernel/solids/solid_state.hpp>

#include <vector>

namespace flexpm {

/// A point that has lost its bond.
struct CrackRow {
    std::int64_t step;
    CrackMode mode;
    Vector position;  ///< when it cracked [m]
    int contact;
    int point;
    double energy;  ///< that its damage had taken by then [J]
};

/// All cracks by step, then contact, then point.
std::vector<CrackRow> crack_rows(const SolidState& s);

/// 1 for each contact one of whose points is intact: its two grains hang together.
std::vector<std::uint8_t> intact_contacts(const SolidState& s);

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
