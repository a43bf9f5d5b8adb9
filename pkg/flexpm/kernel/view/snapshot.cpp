// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Unpacking a specimen.
#include <flexpm/kernel/view/snapshot.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/fem/edge_points.hpp>
#include <flexpm/kernel/measure/grain_stress.hpp>
#include <flexpm/kernel/space_lanes/solid_access.hpp>

#include <algorithm>
#include <limits>
#include <type_traits>

namespace flexpm {

namespace {

void push(std::vector<double>& to, Point p) { to.insert(to.end(), { p.x, p.y }); }
void push(std::vector<double>& to, Vector v) { to.insert(to.end(), { v.x, v.y, v.z }); }

/// The components that a specimen has of a vector or of a tensor.
void push_vector(const Grains& grains, std::vector<double>& to, Vector v)
{
    grains.layout.dimension == 2 ? push(to, in_plane(v)) : push(to, v);
}
void push_tensor(const Grains& grains, std::vector<double>& to, const SpaceTensor& t)
{
    if (grains.layout.dimension == 2)
        to.insert(to.end(), { t.xx, t.yy, t.xy });
    else
        to.insert(to.end(), { t.xx, t.yy, t.zz, t.yz, t.xz, t.xy });
}

std::int32_t size_of(const std::vector<double>& values, int each)
{
    return static_cast<std::int32_t>(values.size()) / each;
}

/// Number of a node in its grain, by its offset.
int number_in(const Grains& grains, int grain, int node)
{
    return (node - grains.block_nodes[grains.block_of(grain)]) / grains.layout.node_stride;
}

/// Velocity of a node, of a rigid grain by its motion [m/s].
template <class State> Vector velocity_of(const State& s, int grain, int node)
{
    if constexpr (std::is_same_v<State, Assembly>)
        return s.grains.velocity_at(node);
    else
        return node_velocity(s, grain, node);
}

/// Add nodes and elements of a grain, whose first node has the number `first` among all.
template <class State> GrainStress add_grain(const State& s, int grain, int first, SnapshotRows& to)
{
    const Grains& grains = s.grains;
    for (int n = 0; n < grains.nodes_of(grain); ++n) {
        const int node = grains.node(grain, n);
        push_vector(grains, to.positions, grains.position(node));
        push_vector(grains, to.reference, grains.vector(grains.reference, node));
        push_vector(grains, to.velocities, velocity_of(s, grain, node));
        push_vector(grains, to.forces, grains.vector(node_forces(s), node));
    }
    int added = 0;
    const GrainStress mean = grain_stress(s, grain, [&](const auto& element) {
        for (int node : element.nodes)
            to.elements.push_back(first + number_in(grains, grain, node));
        to.element_grain.push_back(grains.parent[grain]);
        if (!grains.is_rigid(grain)) push_tensor(grains, to.element_stress, element.stress);
        ++added;
    });
    for (int e = 0; grains.is_rigid(grain) && e < added; ++e)
        push_tensor(grains, to.element_stress, mean.stress);
    return mean;
}

/// A rigid grain has no triangles: a fan shows its shape, and has its mean stress.
void add_fan(const Grains& grains, int grain, int first, const SpaceTensor& stress, Snapshot& s)
{
    const int corners = grains.vertices_of(grain);
    for (int k = 0; k < corners; ++k) {
        s.elements.insert(
            s.elements.end(), { first + k, first + (k + 1) % corners, first + corners });
        s.element_grain.push_back(grains.parent[grain]);
        push_tensor(grains, s.element_stress, stress);
    }
}

void add_polygon(const Assembly& a, int grain, Snapshot& to)
{
    const int first = size_of(to.positions, 2);
    const GrainStress mean = add_grain(a, grain, first, to);
    if (a.grains.is_rigid(grain)) add_fan(a.grains, grain, first, mean.stress, to);
    to.element_particle.resize(to.element_grain.size(), grain);
}

void add_polyhedron(const SolidState& s, int grain, SolidSnapshot& to)
{
    const GrainStress mean = add_grain(s, grain, to.node_offsets.back(), to);
    to.node_offsets.push_back(size_of(to.positions, 3));
    push_tensor(s.grains, to.grain_stress, mean.stress);
    push(to.centres, s.grains.position(s.grains.centre(grain)));
    to.volumes.push_back(mean.volume);
    if (s.grains.is_rigid(grain)) push(to.spins, s.bodies[grain].spin);
}

template <class Crack> void add_crack(const Grains& grains, const Crack& crack, CrackRows& to)
{
    to.crack_step.push_back(crack.step);
    to.crack_mode.push_back(crack.mode);
    push_vector(grains, to.crack_position, crack.position);
    to.crack_energy.push_back(crack.energy);
}

/// Number, grains, places and cracks of a contact of 2D.
void add_bond(const Assembly& a, int contact, std::vector<std::int32_t>& number,
    std::vector<std::int32_t>& grains, std::vector<double>& ends, CrackRows& cracks)
{
    number.push_back(a.contacts.id[contact]);
    for (int grain : a.contacts.pairs[contact])
        grains.push_back(a.grains.parent[grain]);
    for (int end = 0; end < 2; ++end)
        push(ends, contact_end(a, contact, end));
    for (int p = 0; p < a.contacts.points_of(contact); ++p)
        add_crack(a.grains, a.contacts.crack(contact, p), cracks);
}

void add_contact(const Assembly& a, int contact, Snapshot& s)
{
    const int row = static_cast<int>(s.contact.size());
    add_bond(a, contact, s.contact, s.contact_grains, s.contact_ends, s);
    const auto share = edge_points(a.contacts.points_of(contact)).share;
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
    add_bond(a, contact, s.erased_contact, s.erased_grains, s.erased_ends, s.erased);
    const auto [first, second] = a.contacts.pairs[contact];
    if (a.grains.erased[first] || a.grains.erased[second]) {
        std::fill(s.erased_ends.end() - 2 * dimension, s.erased_ends.end(),
            std::numeric_limits<double>::quiet_NaN());
    }
}

void add_face(const SolidState& s, int contact, SolidSnapshot& to)
{
    const FaceContacts& c = s.contacts;
    const GrainPair pair = c.pairs[contact];
    const std::vector<Vector> middle = middle_face(s, contact);
    to.contact_grains.insert(to.contact_grains.end(), { pair[0], pair[1] });
    for (int k = 0; k < c.corners_of(contact); ++k) {
        for (int side = 0; side < 2; ++side)
            to.corner_nodes.push_back(to.node_offsets[pair[side]]
                + number_in(s.grains, pair[side], c.node(contact, side, k)));
        push(to.corners, middle[k]);
    }
    to.corner_offsets.push_back(size_of(to.corners, 3));
    push(to.normals, normal_of(middle));
    const std::vector<FacePlace> places = places_of(s, contact);
    for (int p = 0; p < c.points_of(contact); ++p) {
        const FacePlace& place = places[p];
        const FaceTraction t = traction_of(c, contact, p, place);
        to.point_area.push_back(c.area(contact, p));
        push(to.point_position, point_place(c, contact, p, middle));
        to.point_opening.push_back(place.opening);
        push(to.point_slip, place.slip);
        to.point_damage.push_back(t.damage);
        to.point_traction.insert(to.point_traction.end(), { t.normal, t.shear.x, t.shear.y });
        add_crack(s.grains, c.crack(contact, p), to);
    }
    to.areas.push_back(contact_area(c, contact));
    to.point_offsets.push_back(size_of(to.point_area, 1));
}

/// Make room for the rows of nodes, tetrahedra, corners and points: arrays that grow leave holes in
/// the memory, of a large solid 5 kB a grain.
void reserve_rows(const SolidState& s, SolidSnapshot& to)
{
    std::size_t nodes = 0, corners = 0, points = 0;
    for (int g = 0; g < s.grains.count; ++g)
        nodes += s.grains.nodes_of(g);
    for (int c = 0; c < s.contacts.count; ++c) {
        corners += s.contacts.corners_of(c);
        points += s.contacts.points_of(c);
    }
    const std::size_t elements = static_cast<std::size_t>(s.tetrahedra.batches()) * lanes;
    for (auto* values : { &to.positions, &to.reference, &to.velocities, &to.forces })
        values->reserve(3 * nodes);
    to.elements.reserve(4 * elements);
    to.element_grain.reserve(elements);
    to.element_stress.reserve(6 * elements);
    to.corners.reserve(3 * corners);
    to.corner_nodes.reserve(2 * corners);
    for (auto* values : { &to.point_position, &to.point_traction, &to.crack_position })
        values->reserve(3 * points);
    to.point_slip.reserve(2 * points);
    for (auto* values : { &to.point_area, &to.point_opening, &to.point_damage, &to.crack_energy })
        values->reserve(points);
    to.crack_step.reserve(points);
    to.crack_mode.reserve(points);
}

void add_surface(const SolidState& s, SolidSnapshot& to)
{
    for (std::size_t t = 0; t < s.surface.side.size(); ++t) {
        const int grain = s.surface.grain[t];
        for (int n : s.surface.nodes[t])
            to.surface.push_back(to.node_offsets[grain] + number_in(s.grains, grain, n));
        to.surface_grain.push_back(grain);
        to.surface_side.push_back(s.surface.side[t]);
    }
}

}  // namespace

Point contact_end(const Assembly& a, int contact, int end, double factor)
{
    Point sum;
    for (int side = 0; side < 2; ++side) {
        const auto [from, to] = a.contacts.edge(contact, side);
        const double share = acting_part(a, contact, side)[end];
        const Point p = a.grains.point_at(from, factor), q = a.grains.point_at(to, factor);
        sum = sum + 0.5 * ((1.0 - share) * p + share * q);
    }
    return sum;
}

Snapshot take_snapshot(const Assembly& a)
{
    Snapshot s;
    for (int g = 0; g < a.grains.count; ++g) {
        if (!a.grains.erased[g]) add_polygon(a, g, s);
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

SolidSnapshot take_snapshot(const SolidState& s)
{
    SolidSnapshot to;
    reserve_rows(s, to);
    to.node_offsets = to.corner_offsets = to.point_offsets = { 0 };
    for (int g = 0; g < s.grains.count; ++g)
        add_polyhedron(s, g, to);
    add_surface(s, to);
    for (int c = 0; c < s.contacts.count; ++c)
        add_face(s, c, to);
    return to;
}

}  // namespace flexpm
