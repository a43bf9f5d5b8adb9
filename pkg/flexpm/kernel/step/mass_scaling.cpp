// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Nodal stiffness bound, scaled and real masses.
#include <flexpm/kernel/step/mass_scaling.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/plane_lanes/rigid_grain.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace flexpm {

namespace {

/// Largest singular value of a 2x2 block.
double norm(const StiffnessBlock& k)
{
    const double sum = k.xx * k.xx + k.xy * k.xy + k.yx * k.yx + k.yy * k.yy;
    const double det = k.xx * k.yy - k.xy * k.yx;
    return std::sqrt(0.5 * (sum + std::sqrt(std::max(sum * sum - 4.0 * det * det, 0.0))));
}

void add_elements(const Grains& grains, int grain, Array<double>& bound)
{
    if (grains.is_rigid(grain)) return;
    const int nodes = grains.nodes_of(grain);
    std::vector<StiffnessBlock> rows(nodes * nodes, StiffnessBlock { 0.0, 0.0, 0.0, 0.0 });
    const PlaneStiffness c = stiffness_of(grains, grain);
    for (int t = 0; t < triangles_of(grains, grain); ++t) {
        const auto n = triangle_nodes(grains, grain, t);
        const TriangleShape s = shape_of(grains, grain, t);
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
            bound[grains.scalar_index(grains.node(grain, i))] += norm(rows[i * nodes + j]);
        }
    }
}

/// What one spring does to the degrees of freedom of a side: the forces on them per unit of its
/// force, rotations counted as the grain's radius times the angle.
struct SpringSide {
    bool rigid = false;
    int grain = 0;
    std::array<int, 2> node {};      ///< of a deformable grain
    double share[2] = { 0.0, 0.0 };  ///< of its nodes; of a rigid grain: translation, rotation

    double size() const { return std::fabs(share[0]) + std::fabs(share[1]); }
};

/// A spring along `direction` at share `w` between two nodes of an edge.
SpringSide spring_side(
    const Grains& grains, int grain, std::array<int, 2> edge, double w, Point direction)
{
    if (!grains.is_rigid(grain)) return { false, grain, edge, { 1.0 - w, w } };
    const int c = grains.centre(grain);
    const Point arm = grains.vector_on_edge(grains.reference, edge, w) - grains.reference_at(c);
    return { true, grain, { c, c }, { 1.0, cross(arm, direction) / grains.radius[grain] } };
}

/// Row sums of the spring's stiffness: each degree of freedom takes its share times all shares.
void add_spring(const Grains& grains, const SpringSide& s, double stiffness, StiffnessBound& bound)
{
    bound.node[scalar_index(s.node[0])] += stiffness * std::fabs(s.share[0]);
    if (s.rigid) {
        const double r = grains.radius[s.grain];
        bound.rotation[grains.slot[s.grain]] += r * r * stiffness * std::fabs(s.share[1]);
    } else {
        bound.node[scalar_index(s.node[1])] += stiffness * std::fabs(s.share[1]);
    }
}

void add_contact(const Assembly& a, int contact, StiffnessBound& bound)
{
    const Contacts& contacts = a.contacts;
    const LawParameters& law = contacts.law_of(contact);
    const Point n = bonded_normal(a, contact);
    for (int p = 0; p < contacts.points_of(contact); ++p) {
        const double area = contacts.area(contact, p);
        for (const auto& [direction, stiffness] : { std::pair { n, law.normal_stiffness },
                 std::pair { tangent_of(n), law.shear_stiffness } }) {
            SpringSide sides[2];
            for (int s = 0; s < 2; ++s) {
                sides[s] = spring_side(a.grains, contacts.pairs[contact][s],
                    contacts.edge(contact, s), contacts.weight(contact, p, s), direction);
            }
            // sizes of the shares: 2 in all, more where a point beyond its edge extrapolates
            const double k = stiffness * area * (sides[0].size() + sides[1].size());
            for (const SpringSide& side : sides)
                add_spring(a.grains, side, k, bound);
        }
    }
}

/// Also returns the row sum of the plate itself, along its normal.
double add_plate(const Assembly& a, const Plate& plate, StiffnessBound& bound)
{
    double own = 0.0;
    for (int i = 0; i < plate_points(plate); ++i) {
        const EdgePoint p = edge_point(plate, i);
        const Point n = in_plane(point_normal(plate, i));
        for (const auto& [direction, stiffness] :
            { std::pair { n, p.stiffness }, std::pair { tangent_of(n), p.shear_stiffness } }) {
            const SpringSide s = spring_side(
                a.grains, a.facets.grain[p.facet], a.facets.nodes(p.facet), p.weight, direction);
            const double k = stiffness * (s.size() + 1.0);
            add_spring(a.grains, s, k, bound);
            own += k;
        }
    }
    return own;
}

/// A rigid grain that nothing touches, or that no force turns, gets what one contact of half its
/// size would ask for, so that its masses are finite.
void complete_rigid(const Assembly& a, int grain, StiffnessBound& bound)
{
    if (!a.grains.is_rigid(grain) || a.grains.erased[grain]) return;
    const double r = a.grains.radius[grain];
    const double least = a.area_of(a.contacts.laws.front().normal_stiffness * r);
    double& node = bound.node[a.grains.scalar_index(a.grains.centre(grain))];
    if (node == 0.0) node = least;
    double& rotation = bound.rotation[a.grains.slot[grain]];
    rotation = std::max(rotation, 0.01 * r * r * node);
}

template <class Visit> void for_each_node(const Grains& grains, Visit visit)
{
    for (int g = 0; g < grains.count; ++g) {
        if (grains.erased[g]) continue;
        if (grains.is_rigid(g)) {
            visit(grains.scalar_index(grains.centre(g)));
            continue;
        }
        for (int n = 0; n < grains.nodes_of(g); ++n)
            visit(grains.scalar_index(grains.node(g, n)));
    }
}

/// The mass that the bound asks for at a time step.
double mass_for(double bound, double damping, double dt)
{
    return mass_margin * (1.0 + damping) * bound * dt * dt / 4.0;
}

void scale_plates(Assembly& a, double damping, double dt)
{
    StiffnessBound unused = stiffness_bound(a);
    for (Plate& p : a.plates) {
        if (!p.points.empty()) p.mass = mass_for(add_plate(a, p, unused), damping, dt);
    }
}

}  // namespace

void check_damping(double damping)
{
    if (!(damping >= 0.0 && damping < 1.0)) {
        refuse("damping", damping, "", "must be at least 0 and below 1");
    }
}

Array<double> element_bound(const Grains& grains)
{
    Array<double> bound(grains.inverse_mass.size(), 0.0);
    for (int g = 0; g < grains.count; ++g)
        add_elements(grains, g, bound);
    return bound;
}

StiffnessBound stiffness_bound(const Assembly& a)
{
    StiffnessBound bound;
    bound.node = a.plan.element_bound.empty() ? element_bound(a.grains) : a.plan.element_bound;
    bound.rotation.assign(a.grains.inverse_inertia.size(), 0.0);
    for (int c = 0; c < a.contacts.count; ++c)
        add_contact(a, c, bound);
    for (const Plate& p : a.plates)
        add_plate(a, p, bound);
    for (int g = 0; g < a.grains.count; ++g)
        complete_rigid(a, g, bound);
    return bound;
}

void scale_masses(Assembly& a, double damping, double dt)
{
    check_damping(damping);
    check_positive("time step", dt, "s");
    const StiffnessBound bound = stiffness_bound(a);
    for_each_node(a.grains,
        [&](int i) { a.grains.inverse_mass[i] = 1.0 / mass_for(bound.node[i], damping, dt); });
    for (int g = 0; g < a.grains.count; ++g) {
        const int i = a.grains.slot[g];
        if (!a.grains.is_rigid(g) || a.grains.erased[g]) continue;
        a.grains.inverse_inertia[i] = 1.0 / mass_for(bound.rotation[i], damping, dt);
    }
    scale_plates(a, damping, dt);
}

GrainMass real_mass(const Assembly& a, int grain)
{
    const double density = a.grains.elastic[a.grains.material[grain]].density;
    const PolygonSection section = cell_section(a.grains, grain);
    return { density * a.thickness * section.area, density * a.thickness * section.polar };
}

double equal_sphere(const Assembly& a, int grain)
{
    return std::cbrt(0.75 / pi * a.thickness * cell_section(a.grains, grain).area);
}

namespace {

/// Real mass of a grain on its nodes; of a rigid one its moment of inertia too.
void add_real_mass(const Assembly& a, int g, Array<double>& mass, Array<double>& inertia)
{
    const double density = a.grains.elastic[a.grains.material[g]].density;
    if (a.grains.is_rigid(g)) {
        const GrainMass whole = real_mass(a, g);
        mass[a.grains.scalar_index(a.grains.centre(g))] = whole.mass;
        inertia[a.grains.slot[g]] = whole.inertia;
        return;
    }
    for (int t = 0; t < triangles_of(a.grains, g); ++t) {
        const double share = density / 3.0 * shape_of(a.grains, g, t).volume;
        for (int n : triangle_nodes(a.grains, g, t))
            mass[a.grains.scalar_index(a.grains.node(g, n))] += share;
    }
}

}  // namespace

double stable_step(const Assembly& a, double damping)
{
    check_damping(damping);
    const StiffnessBound bound = stiffness_bound(a);
    double most = 0.0;  // of stiffness / mass
    for_each_node(
        a.grains, [&](int i) { most = std::max(most, bound.node[i] * a.grains.inverse_mass[i]); });
    for (int g = 0; g < a.grains.count; ++g) {
        const int i = a.grains.slot[g];
        if (a.grains.is_rigid(g))
            most = std::max(most, bound.rotation[i] * a.grains.inverse_inertia[i]);
    }
    return 2.0 / std::sqrt(mass_margin * (1.0 + damping) * most);
}

double set_real_masses(Assembly& a, double damping)
{
    check_damping(damping);
    Array<double> mass(a.grains.inverse_mass.size(), 0.0),
        inertia(a.grains.inverse_inertia.size(), 0.0);
    for (int g = 0; g < a.grains.count; ++g)
        add_real_mass(a, g, mass, inertia);
    for_each_node(a.grains, [&](int i) { a.grains.inverse_mass[i] = 1.0 / mass[i]; });
    for (int g = 0; g < a.grains.count; ++g) {
        const int i = a.grains.slot[g];
        if (a.grains.is_rigid(g) && !a.grains.erased[g])
            a.grains.inverse_inertia[i] = 1.0 / inertia[i];
    }
    const double dt = stable_step(a, damping);
    scale_plates(a, damping, dt);
    return dt;
}

}  // namespace flexpm
