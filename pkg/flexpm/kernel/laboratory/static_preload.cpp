// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/static_preload.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/forces/node_sets.hpp>
#include <flexpm/kernel/forces/plate_contact.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/laboratory/end_displacement.hpp>
#include <flexpm/kernel/laboratory/softening_ahead.hpp>
#include <flexpm/kernel/laboratory/steady_motion.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/motion/rigid_grain.hpp>
#include <flexpm/kernel/statics/static_solve.hpp>

#include <algorithm>
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
    for (int e = 0; e < a.edges.count; ++e) {
        const int c = a.grains.centre(a.edges.grain[e]);
        if (!is_on_side(a, e, side) || !(std::fabs(a.grains.reference[c] - middle) < least))
            continue;
        least = std::fabs(a.grains.reference[c] - middle);
        nearest = c;
    }
    return nearest;
}

/// Mean velocity along its normal of what lies before a plate [m/s].
Point velocity_before(const Assembly& a, const Plate& plate, const Array<double>& velocity)
{
    double sum = 0.0;
    for (int i = 0; i < plate_points(plate); ++i) {
        const PlatePoint p = plate_point(plate, i);
        const auto n = a.edges.nodes(p.edge);
        for (int end = 0; end < 2; ++end) {
            const double part = end == 0 ? 1.0 - p.weight : p.weight;
            sum += part * dot(plate.normal, vector_at(velocity, n[end]));
        }
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

/// Kinetic energy of all that is free to move.
double kinetic_energy(const Assembly& a)
{
    double total = kinetic_of_velocities(a.grains);
    for (const Plate& p : a.plates) {
        if (p.loaded) total += 0.5 * p.mass * dot(p.velocity, p.velocity);
    }
    for (const NodeSet& set : a.node_sets)
        total += kinetic_of_velocity(a, set);
    return total;
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

/// Part of its stiffness that a contact keeps which bears nothing. It keeps loose grains in their place.
constexpr double loose = 1e-6;

/// Damage from which on a point counts as a crack for the motion that the loading gives.
constexpr double softened = 0.5;

/// Solutions after which points that open or lift off are not looked for any more.
constexpr int most_lifts = 5;

/// Opening of a plate's point, or damage of a crack's, that marks it as loosened in a copy of the state.
constexpr double loosened = std::numeric_limits<double>::max();

/// Pressure between the faces of a point [Pa]; below 0: they are apart, and it would be there had they stuck.
double pressure_of(const Contacts& contacts, int contact, int point)
{
    const LawParameters& law = contacts.law_of(contact);
    return -law.normal_stiffness * law::gap(law, contacts.point_state(contact, point));
}

/// Whether all of a contact is cracked and its faces slide past each other.
bool slides(const Contacts& contacts, int contact)
{
    const LawParameters& law = contacts.law_of(contact);
    for (int p = 0; p < contacts.points_of(contact); ++p) {
        const PointState s = contacts.point_state(contact, p);
        const double pressure = pressure_of(contacts, contact, p);
        const double limit = sliding_share * law.friction * pressure;
        if (damage_of(contacts, contact, p) < softened) return false;
        if (pressure > 0.0 && std::fabs(s.shear_traction) < limit) return false;
    }
    return true;
}

/// Whether the faces of a contact bear on each other anywhere.
bool is_pressed(const Contacts& contacts, int contact)
{
    for (int p = 0; p < contacts.points_of(contact); ++p) {
        if (pressure_of(contacts, contact, p) > 0.0) return true;
    }
    return false;
}

/// Loosen the points of cracks that a motion opens and that nothing presses together now (deviation D45), and the shear of cracks that slide; returns whether there are any.
///
/// @param laws  number of laws before cracks got theirs
bool loosen_cracks(Assembly& a, int laws, const Array<double>& velocity)
{
    Contacts& contacts = a.contacts;
    bool any = false;
    for (int c = 0; c < contacts.count; ++c) {
        if (contacts.erased[c]) continue;
        const Point n = bonded_normal(a, c);
        for (int p = 0; p < contacts.points_of(c); ++p) {
            double& mark = contacts.state(c, p, PointRow::shear_damage);
            if (damage_of(contacts, c, p) < softened || mark == loosened) continue;
            if (pressure_of(contacts, c, p) > 0.0) continue;
            if (!(dot(n, relative_velocity(contacts, c, p, velocity)) > 0.0)) continue;
            contacts.area(c, p) *= loose;
            mark = loosened;
            any = true;
        }
        if (contacts.law[c] >= laws || !slides(contacts, c)) continue;
        any = true;
        LawParameters law = contacts.law_of(c);
        law.shear_stiffness *= loose;
        contacts.law[c] = static_cast<int>(contacts.laws.size());
        contacts.laws.push_back(law);
    }
    return any;
}

/// Loosen the points of plates that do not press and that a motion takes off; returns whether there are any.
bool loosen_plates(Assembly& a, const Array<double>& velocity)
{
    bool any = false;
    for (Plate& plate : a.plates) {
        if (plate.bonded) continue;
        for (int i = 0; i < plate_points(plate); ++i) {
            const PlatePoint p = plate_point(plate, i);
            const Point v = vector_on_edge(velocity, a.edges.nodes(p.edge), p.weight);
            const bool leaves = dot(plate.normal, v - plate.displacement) > 0.0;
            if (plate.opening[i] < 0.0 || !leaves || plate.opening[i] == loosened) continue;
            plate.area[i] *= loose;
            plate.opening[i] = loosened;
            any = true;
        }
    }
    return any;
}

/// Elastic solution in which cracks and plates bear pressure and friction alone.
StaticSolution unilateral_solution(Assembly& a, const std::vector<Prescribed>& prescribed)
{
    StaticSolution found = solve_static(a, prescribed);
    const int laws = static_cast<int>(a.contacts.laws.size());
    // what one point lets go may take off the next one
    for (int i = 0; i < most_lifts; ++i) {
        const bool cracks = loosen_cracks(a, laws, found.displacement);
        const bool plates = loosen_plates(a, found.displacement);
        if (!cracks && !plates) break;
        found = solve_static(a, prescribed);
    }
    return found;
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
    if (held == Held::by_parts) return unilateral_solution(moved, prescribed);
    // smooth plates leave the specimen free to slide
    prescribed.push_back({ middle_of(a, bottom_side), 0.0 });
    return solve_static(moved, prescribed);
}

/// What the sets' forces grow by, and the velocities of those that float, in an elastic solution at `sense` times their
/// velocities.
void note_rates(Assembly& a, const StaticSolution& found, double sense)
{
    const Grains& grains = a.grains;
    for (NodeSet& set : a.node_sets) {
        const Point pivot = set.pivot - set.displacement;
        set.loading_force = {};
        set.loading_moment = 0.0;
        for (std::size_t i = 0; i < set.nodes.size(); ++i) {
            const int g = set.grains[i];
            Point on = vector_at(found.force, set.nodes[i]);
            for (int k = 0; grains.is_rigid(g) && k < grains.vertices_of(g); ++k)
                on = on + vector_at(found.force, grains.node(g, k));
            const Point held = { set.holds_x ? -sense * on.x : 0.0,
                set.holds_y ? -sense * on.y : 0.0 };
            set.loading_force = set.loading_force + held;
            set.loading_moment += cross(vector_at(grains.reference, set.nodes[i]) - pivot, held);
        }
        if (!set.floats || set.nodes.empty()) continue;
        const int first = set.nodes.front();
        const Point arm = vector_at(grains.reference, first) - pivot;
        const Point v =
            sense * vector_at(found.displacement, first) - set.spin * Point { -arm.y, arm.x };
        set.loading_velocity = { set.holds_x ? v.x : 0.0, set.holds_y ? v.y : 0.0 };
    }
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
    const double before = kinetic_energy(a);
    note_rates(a, found, 1.0);
    for (NodeSet& set : a.node_sets) {
        set.velocity = set.velocity + set.loading_velocity;
        if (!undamped) set.loading_velocity = {};
    }
    for (Plate& p : a.plates) {
        if (!p.loaded) continue;
        p.velocity = velocity_before(a, p, velocity);
        if (undamped) p.loading_velocity = p.velocity;
    }
    Grains& grains = a.grains;
    for (int g = 0; g < grains.count; ++g) {
        if (grains.erased[g]) continue;
        if (grains.is_rigid(g)) {
            const double spin = spin_in(grains, g, velocity);
            const Point v = vector_at(velocity, grains.centre(g));
            add_motion(grains, g, v, spin);
            if (!undamped) continue;
            set_vector(grains.loading_velocity, grains.centre(g), v);
            grains.loading_spin[grains.slot[g]] = spin;
            continue;
        }
        for_each_component(grains, g, [&](int i) {
            if (grains.prescribed[i]) return;
            grains.velocity[i] += velocity[i];
            if (undamped) grains.loading_velocity[i] = velocity[i];
        });
    }
    a.ledger.prescribed_work[0] += kinetic_energy(a) - before;
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
    for (Plate& p : a.plates) {
        if (p.loaded) p.loading_velocity = velocity_before(a, p, velocity);
    }
    Grains& grains = a.grains;
    Array<double>&of_loading = velocity_of_loading(a), &spins = spin_of_loading(a);
    for (int g = 0; g < grains.count; ++g) {
        if (grains.erased[g]) continue;
        if (grains.is_rigid(g)) {
            const Point v = vector_at(velocity, grains.centre(g));
            set_vector(of_loading, grains.centre(g), v);
            spins[grains.slot[g]] = spin_in(grains, g, velocity);
            continue;
        }
        for_each_component(grains, g, [&](int i) {
            if (!grains.prescribed[i]) of_loading[i] = velocity[i];
        });
    }
    return true;
}

int count_softened(const Assembly& a)
{
    int count = 0;
    for (int c = 0; c < a.contacts.count; ++c) {
        for (int p = 0; p < a.contacts.points_of(c); ++p)
            count += damage_of(a.contacts, c, p) >= softened;
    }
    return count;
}

int count_sliding_joints(const Assembly& a)
{
    int count = 0;
    for (int c = 0; c < a.contacts.count; ++c) {
        if (a.contacts.joint[c] < 0 || a.contacts.erased[c]) continue;
        count += is_pressed(a.contacts, c) && slides(a.contacts, c);
    }
    return count;
}

void change_loading(Assembly& a, double ratio)
{
    check_finite("velocity of the loading over that before", ratio, "");
    Grains& grains = a.grains;
    Array<double>&of_loading = velocity_of_loading(a), &spins = spin_of_loading(a);
    const double before = kinetic_energy(a);
    for (Plate& p : a.plates) {
        p.velocity = p.velocity + (ratio - 1.0) * p.loading_velocity;
        p.loading_velocity = ratio * p.loading_velocity;
    }
    for (NodeSet& set : a.node_sets) {
        set.velocity = set.velocity + (ratio - 1.0) * set.loading_velocity;
        set.loading_velocity = ratio * set.loading_velocity;
        set.loading_force = ratio * set.loading_force;
        set.loading_moment *= ratio;
    }
    for (int g = 0; g < grains.count; ++g) {
        if (grains.erased[g]) continue;
        if (grains.is_rigid(g)) {
            const Point v = vector_at(of_loading, grains.centre(g));
            double& spin = spins[grains.slot[g]];
            add_motion(grains, g, (ratio - 1.0) * v, (ratio - 1.0) * spin);
            set_vector(of_loading, grains.centre(g), ratio * v);
            spin *= ratio;
            continue;
        }
        for_each_component(grains, g, [&](int i) {
            if (grains.prescribed[i]) return;  // held since the loading began
            grains.velocity[i] += (ratio - 1.0) * of_loading[i];
            of_loading[i] *= ratio;
        });
    }
    a.ledger.prescribed_work[0] += kinetic_energy(a) - before;
}

void preload(Assembly& a, double share, int steps, double dt)
{
    if (!(share > 0.0 && share < 1.0)) {
        refuse("share of the elastic limit", share, "", "must be above 0 and below 1");
    }
    if (steps < 1) refuse("steps to the elastic limit", steps, "", "must be at least 1");
    const Array<double> velocity = elastic_velocities(a);
    const double factor = share * elastic_time(a, velocity) / (steps * dt);
    check_positive("velocity to the elastic limit over that of the test", factor, "");
    for_each_component(a.grains, [&](int i) {
        a.grains.prescribed[i] = 1;
        a.grains.velocity[i] = factor * velocity[i];
    });
}

void release_preload(Assembly& a, double velocity, double dt, bool undamped)
{
    need_sides(a);
    const double now = a.grains.velocity[component(side_nodes(a, top_side).front(), 1)];
    check_finite("velocity after the preload", velocity, "m/s");
    if (!(std::isfinite(now) && now != 0.0)) {
        refuse("velocity of the preload", now, "m/s", "must not be 0; preload the specimen first");
    }
    for_each_component(a.grains, [&](int i) { a.grains.velocity[i] *= velocity / now; });
    update_prescribed_work(a, dt);
    for_each_component(a.grains, [&](int i) { a.grains.prescribed[i] = 0; });
    grip_bottom(a);
    move_top(a, velocity);
    for_each_component(a.grains, [&](int i) {
        if (undamped && !a.grains.prescribed[i])
            a.grains.loading_velocity[i] = a.grains.velocity[i];
    });
    a.ledger.prescribed_work[0] += kinetic_of_velocities(a.grains);
}

}  // namespace flexpm
