// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/static_preload.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/forces/plate_contact.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/laboratory/end_displacement.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/motion/rigid_grain.hpp>
#include <flexpm/kernel/statics/static_solve.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexpm {

namespace {

/// Relative velocity of a contact point, b to a, at its bonded place, Eqs. 9-10.
Point relative_velocity(
    const Contacts& contacts, int contact, int point, const Array<double>& velocity)
{
    Point sum;
    for (int side = 0; side < 2; ++side) {
        const double sign = side == 0 ? -1.0 : 1.0;
        const double w = contacts.weight(contact, point, side);
        for (int end = 0; end < 2; ++end) {
            const double part = sign * (end == 0 ? 1.0 - w : w);
            sum = sum + part * vector_at(velocity, contacts.node(contact, side, end));
        }
    }
    return sum;
}

/// Largest opening or slip that the strengths allow at once: the time until one is reached.
double time_to_strength(const LawParameters& law, double opening_rate, double slip_rate)
{
    const double infinite = std::numeric_limits<double>::infinity();
    const double normal = law.normal_stiffness * opening_rate;
    const double opening = normal > 0.0 ? law.tensile_strength / normal : infinite;
    // |shear| = c - mu normal
    const double towards = law.shear_stiffness * std::fabs(slip_rate) + law.friction * normal;
    return std::min(opening, towards > 0.0 ? law.cohesion / towards : infinite);
}

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

/// Of all that is free to move.
double kinetic_energy(const Assembly& a)
{
    double total = kinetic_of_velocities(a.grains);
    for (const Plate& p : a.plates) {
        if (p.loaded) total += 0.5 * p.mass * dot(p.velocity, p.velocity);
    }
    return total;
}

void add_motion(Grains& grains, int grain, Point velocity, double spin)
{
    const Point v = vector_at(grains.velocity, grains.centre(grain)) + velocity;
    set_motion(grains, grain, v, grains.spin[grains.slot[grain]] + spin, 1.0);
}

}  // namespace

Array<double> elastic_velocities(const Assembly& a)
{
    std::vector<Prescribed> prescribed;
    for_each_component(a.grains, [&](int i) {
        if (a.grains.prescribed[i]) prescribed.push_back({ i, a.grains.velocity[i] });
    });
    if (a.plates.empty()) return solve_static(a, prescribed).displacement;

    Assembly moved = a;
    moved.plates.clear();
    for (const Plate& p : a.plates) {
        if (p.loaded) continue;
        moved.plates.push_back(p);
        moved.plates.back().displacement = p.velocity;
    }
    // smooth plates leave the specimen free to slide
    prescribed.push_back({ middle_of(a, bottom_side), 0.0 });
    return solve_static(moved, prescribed).displacement;
}

void start_elastically(Assembly& a, bool undamped)
{
    const Array<double> velocity = elastic_velocities(a);
    const double before = kinetic_energy(a);
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

void change_loading(Assembly& a, double ratio)
{
    check_finite("velocity of the loading over that before", ratio, "");
    Grains& grains = a.grains;
    const double before = kinetic_energy(a);
    for (Plate& p : a.plates) {
        p.velocity = p.velocity + (ratio - 1.0) * p.loading_velocity;
        p.loading_velocity = ratio * p.loading_velocity;
    }
    for (int g = 0; g < grains.count; ++g) {
        if (grains.erased[g]) continue;
        if (grains.is_rigid(g)) {
            const Point v = vector_at(grains.loading_velocity, grains.centre(g));
            double& spin = grains.loading_spin[grains.slot[g]];
            add_motion(grains, g, (ratio - 1.0) * v, (ratio - 1.0) * spin);
            set_vector(grains.loading_velocity, grains.centre(g), ratio * v);
            spin *= ratio;
            continue;
        }
        for_each_component(grains, g, [&](int i) {
            if (grains.prescribed[i]) return;  // held since the loading began
            grains.velocity[i] += (ratio - 1.0) * grains.loading_velocity[i];
            grains.loading_velocity[i] *= ratio;
        });
    }
    a.ledger.prescribed_work[0] += kinetic_energy(a) - before;
}

double elastic_time(const Assembly& a, const Array<double>& velocity)
{
    double least = std::numeric_limits<double>::infinity();
    for (int c = 0; c < a.contacts.count; ++c) {
        if (a.contacts.erased[c]) continue;
        const Point n = bonded_normal(a, c);
        const LawParameters& law = a.contacts.law_of(c);
        for (int p = 0; p < a.contacts.points_of(c); ++p) {
            const Point v = relative_velocity(a.contacts, c, p, velocity);
            least = std::min(least, time_to_strength(law, dot(v, n), v.y * n.x - v.x * n.y));
        }
    }
    return least;
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
