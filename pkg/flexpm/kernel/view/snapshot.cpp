// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Unpacking the assembly.
#include <flexpm/kernel/view/snapshot.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/fem/edge_points.hpp>
#include <flexpm/kernel/view/grain_values.hpp>

#include <algorithm>
#include <limits>

namespace flexpm {

namespace {

void push(std::vector<double>& to, Point p) { to.insert(to.end(), { p.x, p.y }); }

/// A rigid grain has no triangles: a fan shows its shape, and has its mean stress.
void add_fan(const Assembly& a, int grain, int first, Snapshot& s)
{
    const int corners = a.grains.vertices_of(grain);
    const Tensor stress = stress_by_forces(a, grain);
    for (int k = 0; k < corners; ++k) {
        s.triangles.insert(
            s.triangles.end(), { first + k, first + (k + 1) % corners, first + corners });
        s.triangle_grain.push_back(a.grains.parent[grain]);
        s.triangle_particle.push_back(grain);
        s.triangle_stress.insert(s.triangle_stress.end(), { stress.xx, stress.yy, stress.xy });
    }
}

void add_grain(const Assembly& a, int grain, Snapshot& s)
{
    const int first = static_cast<int>(s.positions.size() / 2);
    for (int n = 0; n < a.grains.nodes_of(grain); ++n) {
        const int node = a.grains.node(grain, n);
        push(s.positions, a.grains.point_at(node));
        push(s.reference, a.grains.reference_at(node));
        push(s.velocities, a.grains.velocity_at(node));
        push(s.forces, a.grains.force_at(node));
    }
    if (a.grains.is_rigid(grain)) add_fan(a, grain, first, s);
    const PlaneStiffness c = stiffness_of(a.grains, grain);
    for (int t = 0; t < triangles_of(a.grains, grain); ++t) {
        const auto n = triangle_nodes(a.grains, grain, t);
        for (int i : n)
            s.triangles.push_back(first + i);
        s.triangle_grain.push_back(a.grains.parent[grain]);
        s.triangle_particle.push_back(grain);
        const Tensor stress = cauchy_stress(shape_of(a.grains, grain, t), c,
            a.grains.displacement_at(a.grains.node(grain, n[0])),
            a.grains.displacement_at(a.grains.node(grain, n[1])),
            a.grains.displacement_at(a.grains.node(grain, n[2])));
        s.triangle_stress.insert(s.triangle_stress.end(), { stress.xx, stress.yy, stress.xy });
    }
}

/// Number, grains and places of a contact.
void add_place(const Assembly& a, int contact, std::vector<std::int32_t>& number,
    std::vector<std::int32_t>& grains, std::vector<double>& ends)
{
    number.push_back(a.contacts.id[contact]);
    for (int grain : a.contacts.pairs[contact])
        grains.push_back(a.grains.parent[grain]);
    for (int end = 0; end < 2; ++end)
        push(ends, contact_end(a, contact, end));
}

/// When, how and where its points have lost their bond, and what their damage took.
void add_cracks(const Assembly& a, int contact, std::vector<std::int32_t>& step,
    std::vector<std::int32_t>& mode, std::vector<double>& position, std::vector<double>& energy)
{
    for (int p = 0; p < a.contacts.points_of(contact); ++p) {
        const PointCrack crack = a.contacts.crack(contact, p);
        step.push_back(crack.step);
        mode.push_back(crack.mode);
        energy.push_back(crack.energy);
        push(position, crack.position);
    }
}

void add_contact(const Assembly& a, int contact, Snapshot& s)
{
    const int row = static_cast<int>(s.contact.size());
    add_place(a, contact, s.contact, s.contact_grains, s.contact_ends);
    const auto share = edge_points(a.contacts.points_of(contact)).share;
    add_cracks(a, contact, s.crack_step, s.crack_mode, s.crack_position, s.crack_energy);
    for (int p = 0; p < a.contacts.points_of(contact); ++p) {
        s.point_contact.push_back(row);
        s.point_share.push_back(share[p]);
        s.point_opening.push_back(opening_of(a.contacts, contact, p));
        s.point_slip.push_back(slip_of(a.contacts, contact, p));
        s.point_damage.push_back(damage_of(a.contacts, contact, p));
        const PointTraction traction = traction_of(a.contacts, contact, p);
        s.point_traction.insert(s.point_traction.end(), { traction.normal, traction.shear });
    }
}

void add_erased(const Assembly& a, int contact, Snapshot& s)
{
    s.erased_point_bond.insert(s.erased_point_bond.end(), a.contacts.points_of(contact),
        static_cast<int>(s.erased_contact.size()));
    add_place(a, contact, s.erased_contact, s.erased_grains, s.erased_ends);
    const auto [first, second] = a.contacts.pairs[contact];
    if (a.grains.erased[first] || a.grains.erased[second]) {
        std::fill(s.erased_ends.end() - 2 * dimension, s.erased_ends.end(),
            std::numeric_limits<double>::quiet_NaN());
    }
    add_cracks(a, contact, s.erased_crack_step, s.erased_crack_mode, s.erased_crack_position,
        s.erased_crack_energy);
}

}  // namespace

Point contact_end(const Assembly& a, int contact, int end)
{
    Point sum;
    for (int side = 0; side < 2; ++side) {
        const auto [from, to] = a.contacts.edge(contact, side);
        const double share = acting_part(a, contact, side)[end];
        const Point p = a.grains.point_at(from), q = a.grains.point_at(to);
        sum = sum + 0.5 * ((1.0 - share) * p + share * q);
    }
    return sum;
}

Snapshot take_snapshot(const Assembly& a)
{
    Snapshot s;
    for (int g = 0; g < a.grains.count; ++g) {
        if (!a.grains.erased[g]) add_grain(a, g, s);
    }
    for (int c = 0; c < a.contacts.count; ++c) {
        if (a.contacts.erased[c]) {
            add_erased(a, c, s);
        } else {
            add_contact(a, c, s);
        }
    }
    return s;
}

}  // namespace flexpm
