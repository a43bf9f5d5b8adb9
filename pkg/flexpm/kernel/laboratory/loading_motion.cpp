// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/loading_motion.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/parts/node_sets.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/plane_lanes/rigid_grain.hpp>
#include <flexpm/kernel/statics/unilateral_solve.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace flexpm {

namespace {

/// Lateral component of the centre of the grain in the middle of a side.
int middle_of(const Assembly& a, int side)
{
    const std::vector<int> nodes = side_nodes(a, side);
    double middle = 0.0;
    for (int n : nodes)
        middle += a.grains.reference[n] / static_cast<double>(nodes.size());
    int nearest = a.grains.centre(0);
    double least = std::numeric_limits<double>::infinity();
    for (int e = 0; e < a.facets.count; ++e) {
        const int c = a.grains.centre(a.facets.grain[e]);
        if (!is_on_side(a, e, side) || !(std::fabs(a.grains.reference[c] - middle) < least))
            continue;
        least = std::fabs(a.grains.reference[c] - middle);
        nearest = c;
    }
    return nearest;
}

/// Mean velocity along its normal of what lies before a plate [m/s].
Vector velocity_before(const Assembly& a, const Plate& plate, const Array<double>& velocity)
{
    double sum = 0.0;
    for (int i = 0; i < plate_points(plate); ++i) {
        const EdgePoint p = edge_point(plate, i);
        const auto n = a.facets.nodes(p.facet);
        const auto parts = facet_parts(p.weight);
        for (int k = 0; k < facet_nodes; ++k)
            sum += parts[k] * dot(plate.normal, a.grains.vector_at(velocity, n[k]));
    }
    const double mean = sum / plate_points(plate);
    return mean * plate.normal;
}

/// Spin of a rigid grain whose nodes have these velocities [rad/s].
double spin_in(const Grains& grains, int grain, const Array<double>& velocity)
{
    const int c = grains.centre(grain), n = grains.node(grain, 0);
    const Point arm = vector_at(grains.reference, n) - vector_at(grains.reference, c);
    return cross(arm, vector_at(velocity, n) - vector_at(velocity, c)) / dot(arm, arm);
}

/// Add to the motion of a rigid grain what is not held of it.
void add_motion(Grains& grains, int grain, Point velocity, double spin)
{
    const int centre = grains.centre(grain);
    if (grains.prescribed[component(centre, 0)]) velocity.x = 0.0;
    if (grains.prescribed[component(centre, 1)]) velocity.y = 0.0;
    const Point v = vector_at(grains.velocity, centre) + velocity;
    set_motion(grains, grain, v, grains.spin[grains.slot[grain]] + spin, 1.0);
}

/// All components whose velocity is given, not found by a set that floats.
std::vector<Prescribed> given_velocities(const Assembly& a, double sense)
{
    std::vector<std::uint8_t> given(a.grains.prescribed.begin(), a.grains.prescribed.end());
    for (const NodeSet& set : a.node_sets) {
        for (int n : set.nodes) {
            for (int axis = 0; axis < dimension; ++axis)
                if (set.floats && set.holds(axis)) given[component(n, axis)] = 0;
        }
    }
    std::vector<Prescribed> prescribed;
    for_each_component(a.grains, [&](int i) {
        if (given[i]) prescribed.push_back({ i, sense * a.grains.velocity[i] });
    });
    return prescribed;
}

/// Elastic solution of ends, plates and node sets at `sense` times their velocities.
StaticSolution solution_along(const Assembly& a, Held held, double sense)
{
    std::vector<Prescribed> prescribed = given_velocities(a, sense);
    if (a.plates.empty() && held == Held::by_ends) return solve_static(a, prescribed);

    Assembly moved = a;
    moved.plates.clear();
    for (const Plate& p : a.plates) {
        if (p.loaded) continue;
        moved.plates.push_back(p);
        moved.plates.back().displacement = sense * p.velocity;
    }
    for (NodeSet& set : moved.node_sets)
        set.angle = sense * set.spin;
    if (held == Held::by_parts) return solve_unilateral(moved, prescribed);
    // smooth plates leave the specimen free to slide
    prescribed.push_back({ middle_of(a, bottom_side), 0.0 });
    return solve_static(moved, prescribed);
}

/// What the sets' forces grow by, and the velocities of those that float, in an elastic solution at
/// `sense` times their velocities.
void note_rates(Assembly& a, const StaticSolution& found, double sense)
{
    const Grains& grains = a.grains;
    a.loading.sets.resize(a.node_sets.size());
    for (std::size_t s = 0; s < a.node_sets.size(); ++s) {
        const NodeSet& set = a.node_sets[s];
        PartMotion& given = a.loading.sets[s];
        const Vector pivot = set.laid_pivot();
        given.force = {};
        given.moment = {};
        for (std::size_t i = 0; i < set.nodes.size(); ++i) {
            const int g = set.grains[i];
            Point on = vector_at(found.force, set.nodes[i]);
            for (int k = 0; grains.is_rigid(g) && k < grains.vertices_of(g); ++k)
                on = on + vector_at(found.force, grains.node(g, k));
            const Vector held = { set.holds_x ? -sense * on.x : 0.0,
                set.holds_y ? -sense * on.y : 0.0 };
            given.force = given.force + held;
            given.moment =
                given.moment + cross(vector_at(grains.reference, set.nodes[i]) - pivot, held);
        }
        if (!set.floats || set.nodes.empty()) continue;
        const int first = set.nodes.front();
        const Point arm = in_plane(vector_at(grains.reference, first) - pivot);
        const Point v =
            sense * vector_at(found.displacement, first) - velocity_of_spin(set.spin.z, arm);
        given.velocity = { set.holds_x ? v.x : 0.0, set.holds_y ? v.y : 0.0 };
    }
}

/// Bring a part that has this velocity to `ratio` times what the loading gives to it.
void change_part(Vector& velocity, PartMotion& given, double ratio)
{
    velocity = velocity + (ratio - 1.0) * given.velocity;
    given.velocity = ratio * given.velocity;
    given.force = ratio * given.force;
    given.moment = ratio * given.moment;
}

}  // namespace

Array<double> elastic_velocities(const Assembly& a, Held held)
{
    return solution_along(a, held, 1.0).displacement;
}

void start_elastically(Assembly& a, bool undamped, Held held)
{
    const StaticSolution found = solution_along(a, held, 1.0);
    const Array<double>& velocity = found.displacement;
    const double before = kinetic_of_velocities(a);
    note_rates(a, found, 1.0);
    LoadingMotion& loading = a.loading;
    for (std::size_t i = 0; i < a.node_sets.size(); ++i) {
        a.node_sets[i].velocity = a.node_sets[i].velocity + loading.sets[i].velocity;
        if (!undamped) loading.sets[i].velocity = {};
    }
    loading.plates.resize(a.plates.size());
    for (std::size_t i = 0; i < a.plates.size(); ++i) {
        Plate& p = a.plates[i];
        if (!p.loaded) continue;
        p.velocity = velocity_before(a, p, velocity);
        if (undamped) loading.plates[i].velocity = p.velocity;
    }
    Grains& grains = a.grains;
    for (int g = 0; g < grains.count; ++g) {
        if (grains.erased[g]) continue;
        if (grains.is_rigid(g)) {
            const double spin = spin_in(grains, g, velocity);
            const Point v = vector_at(velocity, grains.centre(g));
            add_motion(grains, g, v, spin);
            if (!undamped) continue;
            set_vector(loading.grains.velocity, grains.centre(g), v);
            loading.grains.spin[grains.slot[g]] = spin;
            continue;
        }
        for_each_component(grains, g, [&](int i) {
            if (grains.prescribed[i]) return;
            grains.velocity[i] += velocity[i];
            if (undamped) loading.grains.velocity[i] = velocity[i];
        });
    }
    a.ledger.prescribed_work[0] += kinetic_of_velocities(a) - before;
}

bool renew_loading(Assembly& a, double sense)
{
    StaticSolution found;
    try {
        found = solution_along(a, Held::by_parts, sense);
    } catch (const std::runtime_error&) {
        return false;  // grains have come loose, which nothing holds
    }
    note_rates(a, found, sense);
    Array<double>& velocity = found.displacement;
    for (double& v : velocity)
        v *= sense;
    LoadingMotion& loading = a.loading;
    loading.plates.resize(a.plates.size());
    for (std::size_t i = 0; i < a.plates.size(); ++i) {
        const Plate& p = a.plates[i];
        if (p.loaded) loading.plates[i].velocity = velocity_before(a, p, velocity);
    }
    const Grains& grains = a.grains;
    for (int g = 0; g < grains.count; ++g) {
        if (grains.erased[g]) continue;
        if (grains.is_rigid(g)) {
            const Point v = vector_at(velocity, grains.centre(g));
            set_vector(loading.grains.velocity, grains.centre(g), v);
            loading.grains.spin[grains.slot[g]] = spin_in(grains, g, velocity);
            continue;
        }
        for_each_component(grains, g, [&](int i) {
            if (!grains.prescribed[i]) loading.grains.velocity[i] = velocity[i];
        });
    }
    return true;
}

void change_loading(Assembly& a, double ratio)
{
    check_finite("velocity of the loading over that before", ratio, "");
    Grains& grains = a.grains;
    LoadingMotion& loading = a.loading;
    const double before = kinetic_of_velocities(a);
    loading.plates.resize(a.plates.size());
    for (std::size_t i = 0; i < a.plates.size(); ++i)
        change_part(a.plates[i].velocity, loading.plates[i], ratio);
    loading.sets.resize(a.node_sets.size());
    for (std::size_t i = 0; i < a.node_sets.size(); ++i)
        change_part(a.node_sets[i].velocity, loading.sets[i], ratio);
    for (int g = 0; g < grains.count; ++g) {
        if (grains.erased[g]) continue;
        if (grains.is_rigid(g)) {
            const Point v = vector_at(loading.grains.velocity, grains.centre(g));
            double& spin = loading.grains.spin[grains.slot[g]];
            add_motion(grains, g, (ratio - 1.0) * v, (ratio - 1.0) * spin);
            set_vector(loading.grains.velocity, grains.centre(g), ratio * v);
            spin *= ratio;
            continue;
        }
        for_each_component(grains, g, [&](int i) {
            if (grains.prescribed[i]) return;  // held since the loading began
            grains.velocity[i] += (ratio - 1.0) * loading.grains.velocity[i];
            loading.grains.velocity[i] *= ratio;
        });
    }
    a.ledger.prescribed_work[0] += kinetic_of_velocities(a) - before;
}

Array<double> loading_field(const Assembly& a)
{
    const Grains& grains = a.grains;
    Array<double> field = a.loading.grains.velocity;
    const Array<double>& spins = a.loading.grains.spin;
    for (int g = 0; g < grains.count; ++g) {
        if (!grains.is_rigid(g)) {
            for_each_component(grains, g, [&](int i) {
                if (grains.prescribed[i]) field[i] = grains.velocity[i];
            });
            continue;
        }
        const int c = grains.centre(g);
        const Point middle = grains.point_at(c), velocity = vector_at(field, c);
        const double spin = spins[grains.slot[g]];
        for (int k = 0; k < grains.nodes_of(g); ++k) {
            const int n = grains.node(g, k);
            const Point arm = grains.point_at(n) - middle;
            set_vector(field, n, velocity + velocity_of_spin(spin, arm));
        }
    }
    return field;
}

}  // namespace flexpm
