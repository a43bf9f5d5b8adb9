// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/part_measures.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/laboratory/loading_motion.hpp>
#include <flexpm/kernel/laboratory/softening_ahead.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/parts/node_sets.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/parts/rigid_support.hpp>
#include <flexpm/kernel/statics/stiffness_matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace flexpm {

namespace {

/// Strength that a test is taken to have, over the stress at which its first contact point softens
/// [-].
constexpr double strength_over_softening = 2.0;
/// Time in which sets move by next to nothing at a unit velocity [s].
constexpr double unit_way = 1e-9;

/// Stiffness of the parts against motions of the specimen as one: along x, along y, and about a
/// point over a length [N/m].
struct RigidStiffness {
    Point about;
    double length;
    double value[3][3] = {};

    void add(Point place, const StiffnessBlock& k)
    {
        const Point arm = (1.0 / length) * (place - about);
        const double way[3][2] = { { 1.0, 0.0 }, { 0.0, 1.0 }, { -arm.y, arm.x } };
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) {
                value[i][j] += way[i][0] * (k.xx * way[j][0] + k.xy * way[j][1])
                    + way[i][1] * (k.yx * way[j][0] + k.yy * way[j][1]);
            }
        }
    }
};

RigidStiffness rigid_stiffness(const Assembly& a)
{
    const Grains& grains = a.grains;
    const CentreExtent extent = centre_extent(grains);
    double stiffest = 1.0;
    RigidStiffness k { in_plane(extent.middle), extent.size };
    for (const Plate& plate : a.plates) {
        for (int i = 0; !plate.loaded && i < plate_points(plate); ++i) {
            const EdgePoint p = edge_point(plate, i);
            const auto n = a.facets.nodes(p.facet);
            const StiffnessBlock springs = plate_springs(plate, i);
            k.add(grains.vector_on_edge(grains.reference, n, p.weight), springs);
            stiffest = std::max(stiffest, springs.xx + springs.yy);
        }
    }
    for_each_component(grains, [&](int i) {
        if (!grains.prescribed[i]) return;
        const int axis = grains.layout.axis_of(i);
        const StiffnessBlock held = { axis == 0 ? stiffest : 0.0, 0.0, 0.0,
            axis == 0 ? 0.0 : stiffest };
        k.add(grains.reference_at(i - grains.component(0, axis)), held);
    });
    return k;
}

/// Set of a node that is free to move as it turns; null for none.
const NodeSet* floating_set(const Assembly& a, int component)
{
    for (const NodeSet& set : a.node_sets) {
        for (int n : set.nodes)
            for (int axis = 0; axis < dimension; ++axis)
                if (set.floats && a.grains.component(n, axis) == component) return &set;
    }
    return nullptr;
}

/// Refuse parts that leave the specimen free to follow those that have a velocity.
/// @throws std::invalid_argument  naming how it moves
void require_resistance(const Assembly& a)
{
    const Grains& grains = a.grains;
    const CentreExtent extent = centre_extent(grains);
    RigidSupport support(extent.middle, extent.size);
    double stiffest = 1.0;
    for (const Plate& plate : a.plates) {
        for (int i = 0; !plate.loaded && i < plate_points(plate); ++i) {
            const EdgePoint p = edge_point(plate, i);
            const auto n = a.facets.nodes(p.facet);
            const Vector place = grains.vector_on_edge(grains.reference, n, p.weight)
                + grains.vector_on_edge(grains.displacement, n, p.weight);
            const Vector normal = point_normal(plate, i), along { -normal.y, normal.x, 0.0 };
            support.add(place, normal, p.stiffness, dot(normal, plate.velocity));
            support.add(place, along, p.shear_stiffness, dot(along, plate.velocity));
            stiffest = std::max(stiffest, p.stiffness + p.shear_stiffness);
        }
    }
    for_each_component(grains, [&](int i) {
        if (!grains.prescribed[i]) return;
        const int axis = grains.layout.axis_of(i);
        const Vector along { axis == 0 ? 1.0 : 0.0, axis == 0 ? 0.0 : 1.0, 0.0 };
        const Vector place = grains.point_at(i - grains.component(0, axis));
        if (const NodeSet* set = floating_set(a, i))
            support.add_turning(place - set->pivot, along, stiffest, grains.velocity[i]);
        else
            support.add(place, along, stiffest, grains.velocity[i]);
    });
    support.require_resistance();
}

/// Part of their contacts' stiffness with which driven parts feel nothing, since what they hold has
/// come off [-].
constexpr double no_resistance = 1e-9;

/// Stiffness of contacts of what is driven along the loading [N/m, or N m].
double springs_of(const Assembly& a, const PartGeometry& parts)
{
    const Vector d = parts.direction;
    double sum = 0.0;
    for (const auto& sets : { parts.driven_sets, parts.back_sets }) {
        for (int number : sets) {
            const NodeSet& set = a.node_sets[number];
            for (std::size_t i = 0; i < set.nodes.size(); ++i) {
                const int g = set.grains[i];
                const Vector arm = Vector(a.grains.point_at(set.nodes[i])) - set.pivot;
                const double lever = parts.turns() ? dot(arm, arm) : 1.0;
                sum += own_law(a, g).normal_stiffness * a.thickness * a.grains.radius[g] * lever;
            }
        }
    }
    for (int number : parts.driven) {
        for (int i = 0; i < plate_points(a.plates[number]); ++i) {
            const StiffnessBlock k = plate_springs(a.plates[number], i);
            sum += dot(d, Vector { k.xx * d.x + k.xy * d.y, k.yx * d.x + k.yy * d.y });
        }
    }
    return sum;
}

/// Part of the largest stiffness that is none [-].
constexpr double no_stiffness = 1e-12;

/// Whether a plate's point bears as the plate goes this way against it: not if it lifts off.
bool bears(const Plate& plate, int point, Vector way)
{
    return plate.bonded || plate.points[point].opening < 0.0
        || dot(point_normal(plate, point), way) > 0.0;
}

/// How a soft plate answers to the velocity of its crosshead, if it goes on bearing where it bears.
PlateLag lag_of(const Assembly& a, int number, const Array<double>& velocity)
{
    Plate plate = a.plates[number];
    if (!is_soft(plate) || plate.loaded) return {};
    for (int i = 0; i < plate_points(plate); ++i) {
        const EdgePoint p = edge_point(plate, i);
        const Point v = a.grains.vector_on_edge(velocity, a.facets.nodes(p.facet), p.weight);
        if (!bears(plate, i, plate.velocity - v)) plate.points[i].area = 0.0;
    }
    return plate_lag(a, plate, plate.velocity, &velocity);
}

/// Sum over the driven sets along the loading, of a force and a moment of each.
template <class Force, class Moment>
double sum_of_sets(const PartGeometry& parts, const Force& force, const Moment& moment)
{
    double sum = 0.0;
    for (int s : parts.driven_sets)
        sum += dot(force(s), parts.direction) + dot(moment(s), parts.turn);
    for (int s : parts.back_sets)
        sum -= dot(moment(s), parts.turn);
    return sum;
}

double push(const BondedState& s, const std::vector<int>& plates, Vector direction)
{
    double sum = 0.0;
    for (int p : plates)
        sum += dot(s.plates[p].force, direction);
    return sum;
}

/// Length of the specimen along a direction [m].
double extent_along(const Grains& grains, Vector direction)
{
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (int g = 0; g < grains.count; ++g) {
        const double middle = dot(grains.vector(grains.reference, grains.centre(g)), direction);
        low = std::min(low, middle - grains.radius[g]);
        high = std::max(high, middle + grains.radius[g]);
    }
    return high - low;
}

}  // namespace

void require_held(const Assembly& a)
{
    RigidStiffness k = rigid_stiffness(a);
    auto& m = k.value;
    const double largest = std::max({ m[0][0], m[1][1], m[2][2] });
    const char* const motions[] = { "along x", "along y", "against rotation" };
    const char* const remedies[] = { "give a part friction or a pin, or fix nodes (axes x)",
        "add a part there, or fix nodes (axes y)",
        "add another part apart from the first, give a jaw friction, or fix nodes" };
    for (int i = 0; i < 3; ++i) {
        if (!(m[i][i] > no_stiffness * largest))
            refuse(std::string("parts that fix the specimen ") + motions[i], 0.0, "",
                std::string("must be at least 1; ") + remedies[i]);
        for (int j = i + 1; j < 3; ++j) {
            const double factor = m[j][i] / m[i][i];
            for (int c = i; c < 3; ++c)
                m[j][c] -= factor * m[i][c];
        }
    }
}

double part_load_rate(const Assembly& a, const PartGeometry& parts, const Array<double>& velocity)
{
    double sum = sum_of_sets(
        parts, [&](int set) { return a.loading.of_set(set).force; },
        [&](int set) { return a.loading.of_set(set).moment; });
    for (int number : parts.driven) {
        const Plate& plate = a.plates[number];
        const PlateLag lag = lag_of(a, number, velocity);
        for (int i = 0; i < plate_points(plate); ++i) {
            const EdgePoint p = edge_point(plate, i);
            const Point v = a.grains.vector_on_edge(velocity, a.facets.nodes(p.facet), p.weight);
            const Vector way = point_way(plate, i, plate.velocity, lag) - v;
            if (!bears(plate, i, way)) continue;
            const StiffnessBlock k = plate_springs(plate, i);
            const Vector force = { k.xx * way.x + k.xy * way.y, k.yx * way.x + k.yy * way.y };
            sum += dot(force, parts.direction);
        }
    }
    return sum;
}

void check_parts(const BondedState& s, const PartGeometry& parts)
{
    check_positive("area of a test's load", parts.area, "m2");
    check_positive("length of a test's displacement", parts.length, "m");
    check_positive("length of a loading's direction", norm(parts.direction) + norm(parts.turn), "");
    if (parts.driven.empty() && parts.driven_sets.empty())
        refuse("driven parts", 0.0, "", "must be at least 1");
    for (const auto& plates : { parts.driven, parts.holding }) {
        for (int p : plates) {
            if (p >= 0 && p < static_cast<int>(s.plates.size())) continue;
            refuse("part", p, "", "must be the index of a plate; add one first");
        }
    }
    for (const auto& sets : { parts.driven_sets, parts.back_sets, parts.holding_sets }) {
        for (int n : sets) {
            if (n >= 0 && n < static_cast<int>(s.node_sets.size())) continue;
            refuse("part", n, "", "must be the index of a node set; add one first");
        }
    }
}

EndForces part_forces(const BondedState& s, const PartGeometry& parts)
{
    const double top = push(s, parts.driven, parts.direction)
        + sum_of_sets(
            parts, [&](int set) { return s.node_sets[set].force; },
            [&](int set) { return s.node_sets[set].moment; });
    if (parts.holding.empty() && parts.holding_sets.empty()) return { -top, top };
    double bottom = push(s, parts.holding, parts.direction);
    for (int n : parts.holding_sets)
        bottom += dot(s.node_sets[n].force, parts.direction);
    return { bottom, top };
}

double part_load(const BondedState& s, const PartGeometry& parts)
{
    if (parts.driven.empty() && parts.driven_sets.empty()) return 0.0;
    const EndForces ends = part_forces(s, parts);
    return 0.5 * (ends.top - ends.bottom);
}

double part_displacement(const BondedState& s, const PartGeometry& parts)
{
    if (!parts.driven.empty())
        return dot(s.plates[parts.driven.front()].displacement, parts.direction);
    const NodeSet& set = s.node_sets[parts.driven_sets.front()];
    return dot(set.displacement, parts.direction) + dot(set.angle, parts.turn);
}

CentreExtent centre_extent(const Grains& grains)
{
    const Vector first = grains.vector(grains.reference, grains.centre(0));
    Vector low = first, high = first;
    for (int g = 0; g < grains.count; ++g) {
        const Vector p = grains.vector(grains.reference, grains.centre(g));
        low = { std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z) };
        high = { std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z) };
    }
    const double size = grains.length(high - low);
    return { 0.5 * (low + high), size > 0.0 ? size : 1.0 };
}

TestScales scales_of_parts(const Grains& grains, const PartGeometry& parts,
    const PartSolution& solution, double strength, const ScaleInputs& compressed, double width)
{
    const double modulus = solution.stiffness * parts.length / parts.area;
    double failure = 0.0;
    if (strength == 0.0) {
        strength = strength_over_softening * solution.softening / parts.length * modulus;
        const double extent = parts.turns() ? 1.0 : extent_along(grains, parts.direction);
        failure = failure_displacement(compressed, extent) / parts.length;
    }
    return { std::sqrt(3.0 * solution.mass / solution.stiffness) / compressed.dt, modulus, strength,
        parts.length, width, compressed.damage_share, failure, strength };
}

TestScales part_scales(const Assembly& a, const PartGeometry& parts, double strength, double dt)
{
    check_parts(a, parts);
    check_not_negative("strength", strength, "Pa");
    Assembly moved = a;
    std::fill(moved.grains.velocity.begin(), moved.grains.velocity.end(), 0.0);
    std::fill(moved.grains.spin.begin(), moved.grains.spin.end(), 0.0);
    for (Plate& p : moved.plates)
        p.velocity = {};
    for (int p : parts.driven) {
        moved.plates[p].velocity = parts.direction;
        moved.plates[p].loaded = false;  // its pressure ends as the loading takes it over
        moved.plates[p].machine_stiffness = 0.0;
    }
    require_held(moved);
    for (NodeSet& set : moved.node_sets) {
        set.velocity = {};
        set.spin = {};
    }
    moved.loading.sets.clear();
    for (int s : parts.driven_sets)
        set_motion_of(moved, s, parts.direction, parts.turn);
    for (int s : parts.back_sets)
        set_motion_of(moved, s, {}, -parts.turn);
    drive_node_sets(moved, unit_way);
    require_resistance(moved);
    // a unit velocity turns rigid grains far: their contacts are looked at in the solution itself
    Array<double> solution;
    if (strength == 0.0) solution = elastic_velocities(moved, Held::by_parts);
    start_elastically(moved, false, Held::by_parts);
    double mass = 2.0 * kinetic_of_velocities(moved.grains);
    for (const NodeSet& set : moved.node_sets)
        mass += 2.0 * kinetic_of_velocity(moved, set);
    const double stiffness = part_load_rate(moved, parts, moved.grains.velocity);
    // what moves with them as one feels round-off alone
    if (!(stiffness > no_resistance * springs_of(moved, parts))) {
        refuse("stiffness that the driven parts feel", 0.0, "N/m",
            "must be > 0: nothing resists them; fix a part that is connected to them, e.g. with "
            "hold()");
    }
    const double softening = strength == 0.0 ? elastic_time(moved, solution) : 0.0;
    return scales_of_parts(a.grains, parts, { mass, stiffness, softening }, strength,
        scale_inputs(a, Sense::compression, dt), a.length_of(parts.area));
}

}  // namespace flexpm
