// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The planes of boxes and of prisms around an axis.
#include <flexpm/kernel/space/solid.hpp>

#include <algorithm>
#include <limits>

namespace flexpm {
namespace {

constexpr int fewest_facets = 16;
/// Beyond it facets are finer than any grain.
constexpr double most_facets = 1e6;

}  // namespace

Solid Solid::box(double width, double depth, double height)
{
    check_positive("box: width", width, "m");
    check_positive("box: depth", depth, "m");
    check_positive("box: height", height, "m");
    return { { { { 0.0, 0.0, -1.0 }, 0.0, SolidSide::bottom },
                 { { 1.0, 0.0, 0.0 }, width, SolidSide::right },
                 { { 0.0, 0.0, 1.0 }, height, SolidSide::top },
                 { { -1.0, 0.0, 0.0 }, 0.0, SolidSide::left },
                 { { 0.0, -1.0, 0.0 }, 0.0, SolidSide::front },
                 { { 0.0, 1.0, 0.0 }, depth, SolidSide::back } },
        {}, { width, depth, height }, width * depth * height };
}

Solid Solid::cylinder(double diameter, double height, double grain)
{
    check_positive("cylinder: diameter", diameter, "m");
    check_positive("cylinder: height", height, "m");
    check_positive("cylinder: size of a grain", grain, "m");
    const double around = std::min(pi * diameter / grain, most_facets);
    const int facets = std::max(fewest_facets, static_cast<int>(std::lround(around)));
    const double half = pi / facets, area = 0.25 * pi * diameter * diameter;
    // from the section's area: facets * apothem^2 * tan(half)
    const double apothem = std::sqrt(area / (facets * std::tan(half)));
    const double corner = apothem / std::cos(half);
    Solid solid { { { { 0.0, 0.0, -1.0 }, 0.0, SolidSide::bottom },
                      { { 0.0, 0.0, 1.0 }, height, SolidSide::top } },
        { -corner, -corner, 0.0 }, { corner, corner, height }, area * height };
    for (int k = 0; k < facets; ++k) {
        const double angle = (2 * k + 1) * half;
        solid.walls.push_back(
            { { std::cos(angle), std::sin(angle), 0.0 }, apothem, SolidSide::mantle });
    }
    return solid;
}

double distance_inside(const Solid& solid, Vector p)
{
    double distance = std::numeric_limits<double>::infinity();
    for (const Wall& wall : solid.walls)
        distance = std::min(distance, wall.offset - dot(wall.normal, p));
    return distance;
}

}  // namespace flexpm
