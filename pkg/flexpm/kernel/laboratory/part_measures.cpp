// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/part_measures.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/forces/plate_contact.hpp>
#include <flexpm/kernel/laboratory/static_preload.hpp>
#include <flexpm/kernel/statics/stiffness_matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexpm {

namespace {

/// Strength that a test is taken to have, over the stress at which its first contact point softens [-].
constexpr double strength_over_softening = 2.0;

void check(const Assembly& a, const PartGeometry& parts)
{
    check_positive("area of a test's load", parts.area, "m2");
    check_positive("length of a test's displacement", parts.length, "m");
    check_positive("length of a loading's direction", norm(parts.direction), "");
    if (parts.driven.empty()) refuse("driven parts", 0.0, "", "must be at least 1");
    for (const auto& plates : { parts.driven, parts.holding }) {
        for (int p : plates) {
            if (p >= 0 && p < static_cast<int>(a.plates.size())) continue;
            refuse("part", p, "", "must be the number of a plate; add one first");
        }
    }
}

double push(const Assembly& a, const std::vector<int>& plates, Point direction)
{
    double sum = 0.0;
    for (int p : plates)
        sum += dot(a.plates[p].force, direction);
    return sum;
}

/// Forces along the loading: of the holding plates and of the driven ones.
EndForces ends_of(const Assembly& a, const PartGeometry& parts)
{
    const double top = push(a, parts.driven, parts.direction);
    return { parts.holding.empty() ? -top : push(a, parts.holding, parts.direction), top };
}

}  // namespace

double part_load_rate(const Assembly& a, const PartGeometry& parts, const Array<double>& velocity)
{
    double sum = 0.0;
    for (int number : parts.driven) {
        const Plate& plate = a.plates[number];
        for (int i = 0; i < plate_points(plate); ++i) {
            const PlatePoint p = plate_point(plate, i);
            const Point v = vector_on_edge(velocity, a.edges.nodes(p.edge), p.weight);
            const Point way = plate.velocity - v;
            const StiffnessBlock k = plate_springs(plate, i);
            const Point force = { k.xx * way.x + k.xy * way.y, k.yx * way.x + k.yy * way.y };
            sum += dot(force, parts.direction);
        }
    }
    return sum;
}

double part_load(const Assembly& a, const PartGeometry& parts)
{
    const EndForces ends = ends_of(a, parts);
    return 0.5 * (ends.top - ends.bottom);
}

double part_displacement(const Assembly& a, const PartGeometry& parts)
{
    return dot(a.plates[parts.driven.front()].displacement, parts.direction);
}

AxialObservation observe_parts(const Assembly& a, const PartGeometry& parts)
{
    check(a, parts);
    AxialObservation o = observe_ends(a, ends_of(a, parts), Sense::tension, parts.area);
    o.axial_strain = part_displacement(a, parts) / parts.length;
    o.lateral_strain = std::numeric_limits<double>::quiet_NaN();
    return o;
}

TestScales part_scales(const Assembly& a, const PartGeometry& parts, double strength, double dt)
{
    check(a, parts);
    check_not_negative("strength", strength, "Pa");
    Assembly moved = a;
    std::fill(moved.grains.velocity.begin(), moved.grains.velocity.end(), 0.0);
    std::fill(moved.grains.spin.begin(), moved.grains.spin.end(), 0.0);
    for (Plate& p : moved.plates)
        p.velocity = {};
    for (int p : parts.driven)
        moved.plates[p].velocity = parts.direction;
    start_elastically(moved, false, Held::by_parts);
    const double mass = 2.0 * kinetic_of_velocities(moved.grains);
    const double stiffness = part_load_rate(moved, parts, moved.grains.velocity);
    check_positive("stiffness that the driven parts feel", stiffness, "N/m");
    const double modulus = stiffness * parts.length / parts.area;
    if (strength == 0.0) {
        const double softening = elastic_time(moved, moved.grains.velocity);
        strength = strength_over_softening * softening / parts.length * modulus;
    }
    return { std::sqrt(3.0 * mass / stiffness) / dt, modulus, strength, parts.length,
        parts.area / a.thickness, damage_share(a) };
}

}  // namespace flexpm
