// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Unpacking the assembly.
#include <flexpm/kernel/assembly/snapshot.hpp>

#include <flexpm/kernel/assembly/access.hpp>

#include <algorithm>

namespace flexpm {

namespace {

void push(std::vector<double>& to, Point p) { to.insert(to.end(), { p.x, p.y }); }

/// A rigid grain has no triangles: a fan without stress shows its shape.
void add_fan(const Assembly& a, int grain, int first, Snapshot& s)
{
    const int corners = a.group(a.grain_slot[grain] / lanes).vertices;
    for (int k = 0; k < corners; ++k) {
        s.triangles.insert(
            s.triangles.end(), { first + k, first + (k + 1) % corners, first + corners });
        s.triangle_grain.push_back(a.aggregate[grain]);
        s.triangle_particle.push_back(grain);
        s.triangle_stress.insert(s.triangle_stress.end(), { 0.0, 0.0, 0.0 });
    }
}

void add_grain(const Assembly& a, int grain, Snapshot& s)
{
    const int first = static_cast<int>(s.positions.size() / 2);
    for (int n = 0; n < a.nodes_of(grain); ++n) {
        const int node = a.node(grain, n);
        push(s.positions, a.position(node));
        push(s.reference, { a.reference[node], a.reference[node + lanes] });
        push(s.velocities, { a.velocity[node], a.velocity[node + lanes] });
        push(s.forces, force_of(a, node));
    }
    if (a.is_rigid(grain)) add_fan(a, grain, first, s);
    const PlaneStiffness c = stiffness_of(a, grain);
    for (int t = 0; t < triangles_of(a, grain); ++t) {
        const auto n = triangle_nodes(a, grain, t);
        for (int i : n)
            s.triangles.push_back(first + i);
        s.triangle_grain.push_back(a.aggregate[grain]);
        s.triangle_particle.push_back(grain);
        const Tensor stress =
            cauchy_stress(shape_of(a, grain, t), c, displacement_of(a, a.node(grain, n[0])),
                displacement_of(a, a.node(grain, n[1])), displacement_of(a, a.node(grain, n[2])));
        s.triangle_stress.insert(s.triangle_stress.end(), { stress.xx, stress.yy, stress.xy });
    }
}

void add_contact(const Assembly& a, int contact, Snapshot& s)
{
    for (int side = 0; side < 2; ++side)
        s.contact_grains.push_back(a.aggregate[a.contact_grains[2 * contact + side]]);
    for (int end = 0; end < 2; ++end)
        push(s.contact_ends, contact_end(a, contact, end));
    for (int p = 0; p < a.points; ++p) {
        const int index = row_index(contact, p, a.points);
        s.point_opening.push_back(point_state(a, contact, p).opening);
        s.point_slip.push_back(point_state(a, contact, p).slip);
        s.point_damage.push_back(damage_of(a, contact, p));
        push(s.point_traction, point_traction(a, contact, p));
        s.crack_step.push_back(a.crack_step[index]);
        s.crack_mode.push_back(a.crack_mode[index]);
        push(s.crack_position,
            { a.crack_position[row_index(contact, 2 * p, 2 * a.points)],
                a.crack_position[row_index(contact, 2 * p + 1, 2 * a.points)] });
    }
}

}  // namespace

Point point_traction(const Assembly& a, int contact, int point)
{
    const PointState s = point_state(a, contact, point);
    const LawParameters& law = a.laws[a.contact_law[contact]];
    return { law::normal_traction(law, s.opening, s.max_opening, damage_of(a, contact, point)),
        s.shear_traction };
}

Point contact_end(const Assembly& a, int contact, int end)
{
    Point sum;
    for (int side = 0; side < 2; ++side) {
        const Point p =
            a.position(a.contact_nodes[row_index(contact, 2 * side + end, ContactRows::nodes)]);
        sum.x += 0.5 * p.x;
        sum.y += 0.5 * p.y;
    }
    return sum;
}

Snapshot take_snapshot(const Assembly& a)
{
    Snapshot s;
    for (int g = 0; g < a.grains; ++g)
        add_grain(a, g, s);
    for (int c = 0; c < a.contacts; ++c)
        add_contact(a, c, s);
    return s;
}

}  // namespace flexpm
