// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Leading an assembly along its elastic solution.
#include <flexpm/kernel/static_start.hpp>

#include <flexpm/kernel/axial_test.hpp>
#include <flexpm/kernel/boundary.hpp>
#include <flexpm/kernel/checks.hpp>
#include <flexpm/kernel/elastic_solve.hpp>
#include <flexpm/kernel/grain_access.hpp>
#include <flexpm/kernel/measures.hpp>

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

/// The work of the holders in the second half of the last step goes with the velocities of the next:
/// see integrate_one().
void rebook_driven(Assembly& a, double dt)
{
    for (int block = 0; block < a.blocks(); ++block) {
        const int first = a.block_nodes[block];
        double work = 0.0;
        for (int i = first; i < first + 2 * lanes * a.group(block).nodes; ++i) {
            work -= a.held[i] ? 0.5 * dt * a.force[i] * a.velocity[i] : 0.0;
        }
        a.driven_work[2 * block + 1] = work;
    }
}

}  // namespace

Array<double> elastic_velocities(const Assembly& a)
{
    std::vector<Prescribed> prescribed;
    for_each_component(a, [&](int i) {
        if (a.held[i]) prescribed.push_back({ i, a.velocity[i] });
    });
    return solve_static(a, prescribed).displacement;
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

void lead_elastically(Assembly& a, double share, int steps, double dt)
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

void go_on(Assembly& a, double velocity, double dt)
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
