// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Nodal stiffness bound, scaled and real masses.
#include <flexpm/kernel/mass_scaling.hpp>

#include <flexpm/kernel/checks.hpp>
#include <flexpm/kernel/grain_access.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexpm {

namespace {

/// Largest singular value of a 2x2 block.
double norm(const StiffnessBlock& k)
{
    const double sum = k.xx * k.xx + k.xy * k.xy + k.yx * k.yx + k.yy * k.yy;
    const double det = k.xx * k.yy - k.xy * k.yx;
    return std::sqrt(0.5 * (sum + std::sqrt(std::max(sum * sum - 4.0 * det * det, 0.0))));
}

void add_elements(const Assembly& a, int grain, Array<double>& bound)
{
    const int nodes = a.nodes_of(grain);
    std::vector<StiffnessBlock> rows(nodes * nodes, StiffnessBlock { 0.0, 0.0, 0.0, 0.0 });
    const PlaneStiffness c = stiffness_of(a, grain);
    for (int t = 0; t < triangles_of(a, grain); ++t) {
        const auto n = triangle_nodes(a, grain, t);
        const TriangleShape s = shape_of(a, grain, t);
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) {
                const StiffnessBlock k = stiffness_block(s, c, i, j);
                StiffnessBlock& sum = rows[n[i] * nodes + n[j]];
                sum = { sum.xx + k.xx, sum.xy + k.xy, sum.yx + k.yx, sum.yy + k.yy };
            }
        }
    }
    for (int i = 0; i < nodes; ++i) {
        for (int j = 0; j < nodes; ++j) {
            bound[scalar_index(a.node(grain, i))] += norm(rows[i * nodes + j]);
        }
    }
}

void add_contact(const Assembly& a, int contact, Array<double>& bound)
{
    const LawParameters& law = a.laws[a.contact_law[contact]];
    for (int p = 0; p < a.points; ++p) {
        // sizes of the weights: 2 in all, more where a point beyond its edge extrapolates
        double sizes = 0.0;
        for (int side = 0; side < 2; ++side) {
            const double w = a.weight[row_index(contact, 2 * p + side, 2 * a.points)];
            sizes += std::fabs(1.0 - w) + std::fabs(w);
        }
        const double k = sizes * (law.normal_stiffness + law.shear_stiffness)
            * a.area[row_index(contact, p, a.points)];
        for (int side = 0; side < 2; ++side) {
            const double w = a.weight[row_index(contact, 2 * p + side, 2 * a.points)];
            const int n0 = a.contact_nodes[row_index(contact, 2 * side, ContactRows::nodes)];
            const int n1 = a.contact_nodes[row_index(contact, 2 * side + 1, ContactRows::nodes)];
            bound[scalar_index(n0)] += k * std::fabs(1.0 - w);
            bound[scalar_index(n1)] += k * std::fabs(w);
        }
    }
}

void check_damping(double damping)
{
    if (!(damping >= 0.0 && damping < 1.0)) {
        refuse("damping", damping, "", "must be at least 0 and below 1");
    }
}

template <class Visit> void for_each_node(const Assembly& a, Visit visit)
{
    for (int g = 0; g < a.grains; ++g) {
        for (int n = 0; n < a.nodes_of(g); ++n) visit(scalar_index(a.node(g, n)));
    }
}

}  // namespace

Array<double> stiffness_bound(const Assembly& a)
{
    Array<double> bound(a.inverse_mass.size(), 0.0);
    for (int g = 0; g < a.grains; ++g) add_elements(a, g, bound);
    for (int c = 0; c < a.contacts; ++c) add_contact(a, c, bound);
    return bound;
}

void scale_masses(Assembly& a, double damping, double dt)
{
    check_damping(damping);
    check_positive("time step", dt, "s");
    const Array<double> bound = stiffness_bound(a);
    for_each_node(a, [&](int i) {
        a.inverse_mass[i] = 4.0 / (mass_margin * (1.0 + damping) * bound[i] * dt * dt);
    });
}

double set_real_masses(Assembly& a, double damping)
{
    check_damping(damping);
    Array<double> mass(a.inverse_mass.size(), 0.0);
    for (int g = 0; g < a.grains; ++g) {
        const double third = a.elastic[a.grain_material[g]].density / 3.0;
        for (int t = 0; t < triangles_of(a, g); ++t) {
            const double share = third * shape_of(a, g, t).volume;
            for (int n : triangle_nodes(a, g, t)) mass[scalar_index(a.node(g, n))] += share;
        }
    }
    const Array<double> bound = stiffness_bound(a);
    double least = std::numeric_limits<double>::infinity();
    for_each_node(a, [&](int i) {
        a.inverse_mass[i] = 1.0 / mass[i];
        least = std::min(least, mass[i] / bound[i]);
    });
    return 2.0 * std::sqrt(least / (mass_margin * (1.0 + damping)));
}

}  // namespace flexpm
