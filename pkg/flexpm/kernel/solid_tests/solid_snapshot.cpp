// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/solid_tests/solid_snapshot.hpp>

#include <flexpm/kernel/solids/solid_energies.hpp>
#include <flexpm/kernel/solids/tetrahedron_forces.hpp>
#include <flexpm/kernel/space/face_frame.hpp>

namespace flexpm {

namespace {

void push(std::vector<double>& to, Vector v) { to.insert(to.end(), { v.x, v.y, v.z }); }

void push(std::vector<double>& to, const SpaceTensor& t)
{
    to.insert(to.end(), { t.xx, t.yy, t.zz, t.yz, t.xz, t.xy });
}

Vector place(const SolidState& s, int node)
{
    return space_vector(s.grains.reference, node) + space_vector(s.grains.displacement, node);
}

std::int32_t size_of(const std::vector<double>& values, int each)
{
    return static_cast<std::int32_t>(values.size()) / each;
}

SpaceTensor scaled(double factor, const SpaceTensor& t)
{
    return { factor * t.xx, factor * t.yy, factor * t.zz, factor * t.yz, factor * t.xz,
        factor * t.xy };
}

SpaceTensor sum(const SpaceTensor& a, const SpaceTensor& b)
{
    return { a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.yz + b.yz, a.xz + b.xz, a.xy + b.xy };
}

/// Symmetric part of a dyad.
SpaceTensor dyad(Vector a, Vector b)
{
    return { a.x * b.x, a.y * b.y, a.z * b.z, 0.5 * (a.y * b.z + a.z * b.y),
        0.5 * (a.x * b.z + a.z * b.x), 0.5 * (a.x * b.y + a.y * b.x) };
}

/// Mean stress of a rigid grain in balance, by the forces on its corners.
SpaceTensor stress_by_forces(const SolidState& s, int grain, double volume)
{
    SpaceTensor total {};
    const Vector centre = place(s, s.grains.centre(grain));
    for (int n = 0; n < s.grains.vertices_of(grain); ++n) {
        const int node = s.grains.node(grain, n);
        total = sum(total, dyad(place(s, node) - centre, space_vector(s.grains.force, node)));
    }
    return scaled(1.0 / volume, total);
}

/// Number of a node among all, by its offset.
std::int32_t number_of(const SolidState& s, const SolidSnapshot& to, int grain, int node)
{
    const int first = s.grains.block_nodes[s.grains.block_of(grain)];
    return to.node_offsets[grain] + (node - first) / s.grains.layout.node_stride;
}

Vector velocity_of(const SolidState& s, int grain, int node)
{
    if (s.bodies.empty()) return space_vector(s.grains.velocity, node);
    const int centre = s.grains.centre(grain);
    return space_vector(s.grains.velocity, centre)
        + cross(s.bodies[grain].spin, place(s, node) - place(s, centre));
}

void add_grain(const SolidState& s, int grain, SolidSnapshot& to)
{
    const Grains& grains = s.grains;
    for (int n = 0; n < grains.nodes_of(grain); ++n) {
        const int node = grains.node(grain, n);
        push(to.positions, place(s, node));
        push(to.reference, space_vector(grains.reference, node));
        push(to.velocities, velocity_of(s, grain, node));
        push(to.forces, space_vector(grains.force, node));
    }
    to.node_offsets.push_back(size_of(to.positions, 3));
    const int block = grains.block_of(grain);
    const auto c =
        load_rows<PlaneStiffness>(&grains.stiffness[block * row_count<PlaneStiffness> * lanes], 0);
    const std::size_t first = to.tetrahedra.size() / 4;
    double volume = 0.0;
    SpaceTensor mean {};
    for_each_tetrahedron(s, block, [&](const TetrahedronShape& t, std::array<int, 4> nodes) {
        for (int n : nodes)
            to.tetrahedra.push_back(number_of(s, to, grain, n));
        to.tetrahedron_grain.push_back(grain);
        volume += t.volume;
        if (grains.is_rigid(grain)) return;
        const auto way = [&](int k) { return space_vector(grains.displacement, nodes[k]); };
        const SpaceTensor stress = cauchy_stress(t, c, way(0), way(1), way(2), way(3));
        push(to.tetrahedron_stress, stress);
        mean = sum(mean, scaled(t.volume, stress));
    });
    mean = grains.is_rigid(grain) ? stress_by_forces(s, grain, volume) : scaled(1.0 / volume, mean);
    for (std::size_t t = first; grains.is_rigid(grain) && t < to.tetrahedra.size() / 4; ++t)
        push(to.tetrahedron_stress, mean);
    push(to.grain_stress, mean);
    push(to.centres, place(s, grains.centre(grain)));
    to.volumes.push_back(volume);
    if (grains.is_rigid(grain)) push(to.spins, s.bodies[grain].spin);
}

/// Corners of the middle face.
std::vector<Vector> middle_face(const SolidState& s, int contact)
{
    std::vector<Vector> middle;
    for (int k = 0; k < s.contacts.corners_of(contact); ++k)
        middle.push_back(0.5
            * (place(s, s.contacts.node(contact, 0, k))
                + place(s, s.contacts.node(contact, 1, k))));
    return middle;
}

/// Unit normal of a polygon, from the first grain to the second.
Vector normal_of(const std::vector<Vector>& corners)
{
    Vector twice;
    for (std::size_t k = 1; k + 1 < corners.size(); ++k)
        twice = twice + cross(corners[k] - corners[0], corners[k + 1] - corners[0]);
    const double size = norm(twice);
    return size > 0.0 ? (1.0 / size) * twice : Vector {};
}

void add_point(
    const SolidState& s, int contact, int p, const std::vector<Vector>& middle, SolidSnapshot& to)
{
    const FaceContacts& c = s.contacts;
    Vector at;
    for (int k = 0; k < c.corners_of(contact); ++k)
        at = at + c.share(contact, p, k) * middle[k];
    const FacePlace place = c.place_of(contact, p);
    const FaceTraction t = traction_of(c, contact, p);
    const FaceCrack& crack = c.crack(contact, p);
    to.point_area.push_back(c.area(contact, p));
    push(to.point_position, at);
    to.point_opening.push_back(place.opening);
    to.point_slip.insert(to.point_slip.end(), { place.slip.x, place.slip.y });
    to.point_damage.push_back(t.damage);
    to.point_traction.insert(to.point_traction.end(), { t.normal, t.shear.x, t.shear.y });
    to.crack_step.push_back(crack.step);
    to.crack_mode.push_back(crack.mode);
    push(to.crack_position, crack.position);
    to.crack_energy.push_back(crack.energy);
}

void add_contact(const SolidState& s, int contact, SolidSnapshot& to)
{
    const FaceContacts& c = s.contacts;
    const GrainPair pair = c.pairs[contact];
    const std::vector<Vector> middle = middle_face(s, contact);
    to.contact_grains.insert(to.contact_grains.end(), { pair[0], pair[1] });
    for (int k = 0; k < c.corners_of(contact); ++k) {
        for (int side = 0; side < 2; ++side)
            to.corner_nodes.push_back(number_of(s, to, pair[side], c.node(contact, side, k)));
        push(to.corners, middle[k]);
    }
    to.corner_offsets.push_back(size_of(to.corners, 3));
    push(to.normals, normal_of(middle));
    double area = 0.0;
    for (int p = 0; p < c.points_of(contact); ++p) {
        area += c.area(contact, p);
        add_point(s, contact, p, middle, to);
    }
    to.areas.push_back(area);
    to.point_offsets.push_back(size_of(to.point_area, 1));
}

}  // namespace

SolidSnapshot take_snapshot(const SolidState& s)
{
    SolidSnapshot to;
    to.node_offsets = to.corner_offsets = to.point_offsets = { 0 };
    for (int g = 0; g < s.grains.count; ++g)
        add_grain(s, g, to);
    for (std::size_t t = 0; t < s.surface.side.size(); ++t) {
        const int grain = s.surface.grain[t];
        for (int n : s.surface.nodes[t])
            to.surface.push_back(number_of(s, to, grain, n));
        to.surface_grain.push_back(grain);
        to.surface_side.push_back(s.surface.side[t]);
    }
    for (int c = 0; c < s.contacts.count; ++c)
        add_contact(s, c, to);
    return to;
}

}  // namespace flexpm
