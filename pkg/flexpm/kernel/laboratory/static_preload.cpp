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

/// Calls visit(index) for both components of all nodes of grains, not of padded lanes.
template <class Visit> void for_each_component(const Assembly& a, Visit visit)
{
    for (int g = 0; g < a.grains; ++g) {
        for (int n = 0; n < a.nodes_of(g); ++n) {
            visit(a.node(g, n));
            visit(a.node(g, n) + lanes);
        }
    }
}

/// Relative velocity of a contact point, b to a, at its bonded place, Eqs. 9-10.
Point relative_velocity(const Assembly& a, int contact, int point, const Array<double>& velocity)
{
    Point sum;
    for (int side = 0; side < 2; ++side) {
        const double sign = side == 0 ? -1.0 : 1.0;
        const double w = a.weight[row_index(contact, 2 * point + side, 2 * a.points)];
        for (int end = 0; end < 2; ++end) {
            const double part = sign * (end == 0 ? 1.0 - w : w);
            const int n = a.contact_nodes[row_index(contact, 2 * side + end, ContactRows::nodes)];
            sum.x += part * velocity[n];
            sum.y += part * velocity[n + lanes];
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
        middle += a.reference[n] / static_cast<double>(nodes.size());
    int nearest = a.centre(0);
    double least = std::numeric_limits<double>::infinity();
    for (int e = 0; e < a.edges; ++e) {
        const int c = a.centre(a.edge_grain[e]);
        if (a.edge_side[e] != side || !(std::fabs(a.reference[c] - middle) < least)) continue;
        least = std::fabs(a.reference[c] - middle);
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
        const auto n = edge_nodes(a, p.edge);
        for (int end = 0; end < 2; ++end) {
            const double part = end == 0 ? 1.0 - p.weight : p.weight;
            sum += part
                * (plate.normal.x * velocity[n[end]] + plate.normal.y * velocity[n[end] + lanes]);
        }
    }
    const double mean = sum / plate_points(plate);
    return { mean * plate.normal.x, mean * plate.normal.y };
}

/// Spin of a rigid grain whose nodes have these velocities [rad/s].
double spin_in(const Assembly& a, int grain, const Array<double>& velocity)
{
    const int c = a.centre(grain), n = a.node(grain, 0);
    const double x = a.reference[n] - a.reference[c];
    const double y = a.reference[n + lanes] - a.reference[c + lanes];
    const double vx = velocity[n] - velocity[c];
    const double vy = velocity[n + lanes] - velocity[c + lanes];
    return (x * vy - y * vx) / (x * x + y * y);
}

}  // namespace

Array<double> elastic_velocities(const Assembly& a)
{
    std::vector<Prescribed> prescribed;
    for_each_component(a, [&](int i) {
        if (a.held[i]) prescribed.push_back({ i, a.velocity[i] });
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

void start_elastically(Assembly& a)
{
    const Array<double> velocity = elastic_velocities(a);
    for (Plate& p : a.plates) {
        if (p.loaded) p.velocity = velocity_before(a, p, velocity);
    }
    for (int g = 0; g < a.grains; ++g) {
        if (a.is_rigid(g)) {
            const int c = a.centre(g);
            const Point v = { a.velocity[c] + velocity[c],
                a.velocity[c + lanes] + velocity[c + lanes] };
            set_motion(a, g, v, a.spin[rigid_index(a, g)] + spin_in(a, g, velocity), 1.0);
            continue;
        }
        for (int n = 0; n < a.nodes_of(g); ++n) {
            for (int i : { a.node(g, n), a.node(g, n) + lanes }) {
                if (!a.held[i]) a.velocity[i] += velocity[i];
            }
        }
    }
}

double elastic_time(const Assembly& a, const Array<double>& velocity)
{
    double least = std::numeric_limits<double>::infinity();
    for (int c = 0; c < a.contacts; ++c) {
        const Point n = bonded_normal(a, c);
        const LawParameters& law = a.laws[a.contact_law[c]];
        for (int p = 0; p < a.points; ++p) {
            const Point v = relative_velocity(a, c, p, velocity);
            least = std::min(
                least, time_to_strength(law, v.x * n.x + v.y * n.y, v.y * n.x - v.x * n.y));
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
    for_each_component(a, [&](int i) {
        a.held[i] = 1;
        a.velocity[i] = factor * velocity[i];
    });
}

void release_preload(Assembly& a, double velocity, double dt)
{
    const double now = a.velocity[side_nodes(a, top_side).front() + lanes];
    for_each_component(a, [&](int i) { a.velocity[i] *= velocity / now; });
    rebook_driven(a, dt);
    for_each_component(a, [&](int i) { a.held[i] = 0; });
    grip_bottom(a);
    move_top(a, velocity);
    a.initial_energy += kinetic_of_velocities(a);
}

}  // namespace flexpm
