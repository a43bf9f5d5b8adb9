// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Outline of a specimen in space: a convex solid between planes. SI units.
#pragma once

#include <flexpm/kernel/core/space_vector.hpp>

#include <vector>

namespace flexpm {

/// Side of a specimen that a wall belongs to; the mantle of a cylinder or a disc is one, and so are
/// the flanks of a notch.
enum class SolidSide {
    bottom = 0,
    right = 1,
    mantle = 1,
    top = 2,
    left = 3,
    front = 4,
    back = 5,
    notch = 6,
    hole = 7  ///< wall of the first hole; the next hole is one more
};

constexpr bool is_of_hole(int side) { return side >= static_cast<int>(SolidSide::hole); }

constexpr bool is_end(SolidSide side)
{
    return side == SolidSide::bottom || side == SolidSide::top;
}

/// Plane that bounds a solid: points p with dot(normal, p) > offset lie outside.
struct Wall {
    Vector normal;  ///< outwards, of length 1
    double offset;  ///< [m]
    SolidSide side;
};

/// Convex solid that the cells fill.
struct Solid {
    std::vector<Wall> walls;
    Vector low, high;     ///< corners of the box around it [m]
    double volume = 0.0;  ///< [m^3]

    /// Box from the origin: width along x, depth along y, height along z, the axis of tests.
    /// @throws std::invalid_argument  unless all are finite and above 0
    static Solid box(double width, double depth, double height);
    /// Upright cylinder about the z axis from z = 0, as a prism of the same section: a facet for
    /// each grain of the given size around it, and at least 16 (deviation D63).
    /// @throws std::invalid_argument  unless all are finite and above 0
    static Solid cylinder(double diameter, double height, double grain);
    /// Disc about the y axis from y = 0, as a prism of the same section: a facet for each grain
    /// around it, an even number, one below and one on top. Tests load it along z.
    /// @throws std::invalid_argument  unless all are finite and above 0
    static Solid disc(double diameter, double depth, double grain);
    /// Upper half of a disc about the y axis from y = 0, flat below at z = 0, as a prism of half
    /// its area: a facet for each grain around it, an odd number, the middle one the top.
    /// @throws std::invalid_argument  unless all are finite and above 0
    static Solid half_disc(double diameter, double depth, double grain);
};

/// Distance from the nearest wall, positive inside [m].
double distance_inside(const Solid& solid, Vector p);

}  // namespace flexpm
