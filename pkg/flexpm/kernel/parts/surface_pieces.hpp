// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  What of a surface triangle lies before a plate of a test. SI units.
#pragma once

#include <flexpm/kernel/assembly/solid_state.hpp>
#include <flexpm/kernel/core/space_vector.hpp>

#include <array>
#include <vector>

namespace flexpm {

/// Gap over the size of a part that is none: round-off [-].
constexpr double no_gap = 1e-9;

/// Half space n x <= most.
struct HalfSpace {
    Vector normal;
    double most = 0.0;  ///< [m]
};

/// Part of a triangle.
struct Piece {
    double share = 0.0;               ///< of its area [-]; 0: none
    std::array<double, 3> middle {};  ///< shares of the corners in its middle
    Vector place;                     ///< of the middle [m]
};

/// Whether a plate may touch a triangle: within 60 degrees it faces the plate's normal.
/// @param outwards  any length along the triangle's normal
bool faces(const Plate& plate, Vector outwards);

/// Part of a surface triangle, at the reference, that lies in all of some half spaces.
Piece piece_of(const SolidState& s, int triangle, const std::vector<HalfSpace>& within);

/// Let a plate touch at once with its nearest points: gaps are counted from there.
/// @param nearest  least gap [m]
/// @param none     gap beyond it that is none [m]
void set_gaps(Plate& plate, double nearest, double none);

/// Let a plate touch a piece of a triangle, in its middle.
void add_touch(const SolidState& s, Plate& plate, int triangle, const Piece& piece);

}  // namespace flexpm
