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

/// Regular polygon with the area of a circle.
struct Section {
    int facets;
    double half;  ///< of the angle of a facet [rad]
    double apothem, corner, area;

    /// @param multiple  of which the number of facets is one, and `more`
    Section(double diameter, double grain, int multiple, int more = 0)
    {
        const double around = std::min(pi * diameter / grain, most_facets) / multiple;
        facets = std::max(fewest_facets, multiple * static_cast<int>(std::lround(around))) + more;
        half = pi / facets;
        area = 0.25 * pi * diameter * diameter;
        // from the section's area: facets * apothem^2 * tan(half)
        apothem = std::sqrt(area / (facets * std::tan(half)));
        corner = apothem / std::cos(half);
    }
};

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
    const Section of(diameter, grain, 1);
    Solid solid { { { { 0.0, 0.0, -1.0 }, 0.0, SolidSide::bottom },
                      { { 0.0, 0.0, 1.0 }, height, SolidSide::top } },
        { -of.corner, -of.corner, 0.0 }, { of.corner, of.corner, height }, of.area * height };
    for (int k = 0; k < of.facets; ++k) {
        const double angle = (2 * k + 1) * of.half;
        solid.walls.push_back(
            { { std::cos(angle), std::sin(angle), 0.0 }, of.apothem, SolidSide::mantle });
    }
    return solid;
}

Solid Solid::disc(double diameter, double depth, double grain)
{
    check_positive("disc: diameter", diameter, "m");
    check_positive("disc: depth", depth, "m");
    check_positive("disc: size of a grain", grain, "m");
    const Section of(diameter, grain, 2);
    Solid solid { { { { 0.0, -1.0, 0.0 }, 0.0, SolidSide::front },
                      { { 0.0, 1.0, 0.0 }, depth, SolidSide::back },
                      { { 0.0, 0.0, -1.0 }, of.apothem, SolidSide::mantle },
                      { { 0.0, 0.0, 1.0 }, of.apothem, SolidSide::mantle } },
        { -of.corner, 0.0, -of.corner }, { of.corner, depth, of.corner }, of.area * depth };
    for (int k = 1; 2 * k < of.facets; ++k) {
        const double sine = std::sin(2 * k * of.half), cosine = std::cos(2 * k * of.half);
        solid.walls.push_back({ { sine, 0.0, cosine }, of.apothem, SolidSide::mantle });
        solid.walls.push_back({ { -sine, 0.0, cosine }, of.apothem, SolidSide::mantle });
    }
    return solid;
}

Solid Solid::half_disc(double diameter, double depth, double grain)
{
    check_positive("half_disc: diameter", diameter, "m");
    check_positive("half_disc: depth", depth, "m");
    check_positive("half_disc: size of a grain", grain, "m");
    const Section of(diameter, grain, 4, 2);
    Solid solid { { { { 0.0, -1.0, 0.0 }, 0.0, SolidSide::front },
                      { { 0.0, 1.0, 0.0 }, depth, SolidSide::back },
                      { { 0.0, 0.0, -1.0 }, 0.0, SolidSide::bottom },
                      { { 0.0, 0.0, 1.0 }, of.apothem, SolidSide::top } },
        { -of.corner, 0.0, 0.0 }, { of.corner, depth, of.apothem }, 0.5 * of.area * depth };
    for (int k = 1; 4 * k < of.facets; ++k) {
        const double sine = std::sin(2 * k * of.half), cosine = std::cos(2 * k * of.half);
        solid.walls.push_back({ { sine, 0.0, cosine }, of.apothem, SolidSide::mantle });
        solid.walls.push_back({ { -sine, 0.0, cosine }, of.apothem, SolidSide::mantle });
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
