// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Axial loading of a rectangle.
#include <flexpm/kernel/axial_test.hpp>

#include <flexpm/kernel/boundary.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace flexpm {

namespace {

constexpr int lateral = 0, axial = 1;

void need_sides(const Assembly& a)
{
    for (int side : { bottom_side, right_side, top_side, left_side }) {
        if (side_nodes(a, side).size() >= 2) continue;
        throw std::invalid_argument("specimen side " + std::to_string(side)
            + " has no edges, an axial test needs a rectangle of four sides; use another outline");
    }
}

}  // namespace

TestState judge(const AxialObservation& now, double peak, const AxialEnd& end)
{
    if (peak >= end.least_peak && now.axial_stress < end.stop_ratio * peak) {
        return TestState::past_peak;
    }
    return now.axial_strain >= end.largest_strain ? TestState::largest_strain_reached
                                                  : TestState::running;
}

AxialGeometry rectangle_of(const Assembly& a, Sense sense)
{
    need_sides(a);
    return { side_length(a, bottom_side), side_length(a, left_side), sense };
}

AxialObservation observe(const Assembly& a, const AxialGeometry& g)
{
    const double sign = g.sense == Sense::compression ? -1.0 : 1.0;
    const double top = reaction(a, side_nodes(a, top_side), axial);
    const double bottom = reaction(a, side_nodes(a, bottom_side), axial);
    AxialObservation o;
    o.step = a.step;
    o.axial_strain
        = sign * (side_displacement(a, top_side, axial) - side_displacement(a, bottom_side, axial))
        / g.height;
    o.lateral_strain = -sign
        * (side_displacement(a, right_side, lateral) - side_displacement(a, left_side, lateral))
        / g.width;
    o.axial_stress = sign * top / (g.width * a.thickness);
    for (int e = 0; e < a.edges; ++e) {
        if (a.edge_side[e] == right_side) o.confinement = a.edge_pressure[e];
    }
    const double larger = std::max(std::fabs(top), std::fabs(bottom));
    o.end_mismatch = larger > 0.0 ? std::fabs(top + bottom) / larger : 0.0;
    o.unbalanced_ratio = unbalanced_ratio(a);
    o.cracks = count_cracks(a);
    o.energies = energies(a);
    return o;
}

void grip_ends(Assembly& a)
{
    need_sides(a);
    const std::vector<int> bottom = side_nodes(a, bottom_side);
    drive(a, bottom, axial, 0.0);
    drive(a, side_nodes(a, top_side), axial, 0.0);
    // the node nearest to the middle: the specimen then bulges evenly
    double middle = 0.0;
    for (int n : bottom) middle += a.reference[n] / static_cast<double>(bottom.size());
    const int nearest = *std::min_element(bottom.begin(), bottom.end(), [&](int m, int n) {
        return std::fabs(a.reference[m] - middle) < std::fabs(a.reference[n] - middle);
    });
    drive(a, { nearest }, lateral, 0.0);
}

void move_top(Assembly& a, double velocity) { drive(a, side_nodes(a, top_side), axial, velocity); }

double series_modulus(const Assembly& a)
{
    double diameter = 0.0;
    for (double r : a.radius) diameter += 2.0 * r / a.grains;
    return 1.0 / (1.0 / a.elastic[0].young + 1.0 / (a.laws[0].normal_stiffness * diameter));
}

double crossing_steps(const Assembly& a, double dt)
{
    const AxialGeometry g = rectangle_of(a, Sense::compression);
    double mass = 0.0;
    for (double m : a.inverse_mass) mass += m > 0.0 ? 1.0 / m : 0.0;
    return std::sqrt(mass * g.height / (series_modulus(a) * g.width * a.thickness)) / dt;
}

double reference_strength(const Assembly& a, Sense sense)
{
    const LawParameters& law = a.laws[0];
    if (sense == Sense::tension) return law.tensile_strength;
    // cos(phi) / (1 - sin(phi)) with tan(phi) = mu
    return 2.0 * law.cohesion * (std::sqrt(1.0 + law.friction * law.friction) + law.friction);
}

}  // namespace flexpm
