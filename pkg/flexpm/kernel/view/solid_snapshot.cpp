// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/view/solid_snapshot.hpp>

#include <flexpm/kernel/space_lanes/solid_access.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>

namespace flexpm {

namespace {

void push(std::vector<double>& to, Vector v) { to.insert(to.end(), { v.x, v.y, v.z }); }

void push(std::vector<double>& to, const SpaceTensor& t)
{
    to.insert(to.end(), { t.xx, t.yy, t.zz, t.yz, t.xz, t.xy });
}

std::int32_t size_of(const std::vector<double>& values, int each)
{
    return static_cast<std::int32_t>(values.size()) / each;
}

/// Number of a node among all, by its offset.
std::int32_t number_of(const SolidState& s, const SolidSnapshot& to, int grain, int node)
{
    const int first = s.grains.block_nodes[s.grains.block_of(grain)];
    return to.node_offsets[grain] + (node - first) / s.grains.layout.node_stride;
}

void add_grain(const SolidState& s, int grain, SolidSnapshot& to)
{
    const Grains& grains = s.grains;
    for (int n = 0; n < grains.nodes_of(grain); ++n) {
        const int node = grains.node(grain, n);
        push(to.positions, grains.position(node));
        push(to.reference, space_vector(grains.reference, node));
        push(to.velocities, node_velocity(s, grain, node));
        push(to.forces, space_vector(grains.force, node));
    }
    to.node_offsets.push_back(size_of(to.positions, 3));
    const std::size_t first = to.tetrahedra.size() / 4;
    const GrainStress mean = grain_stress(s, grain,
        [&](const TetrahedronShape&, std::array<int, 4> nodes, const SpaceTensor& stress) {
            for (int n : nodes)
                to.tetrahedra.push_back(number_of(s, to, grain, n));
            to.tetrahedron_grain.push_back(grain);
            if (!grains.is_rigid(grain)) push(to.tetrahedron_stress, stress);
        });
    for (std::size_t t = first; grains.is_rigid(grain) && t < to.tetrahedra.size() / 4; ++t)
        push(to.tetrahedron_stress, mean.stress);
    push(to.grain_stress, mean.stress);
    push(to.centres, grains.position(grains.centre(grain)));
    to.volumes.push_back(mean.volume);
    if (grains.is_rigid(grain)) push(to.spins, s.bodies[grain].spin);
}

void add_point(const FaceContacts& c, int contact, int p, const FacePlace& place,
    const std::vector<Vector>& middle, SolidSnapshot& to)
{
    const FaceTraction t = traction_of(c, contact, p, place);
    const FaceCrack& crack = c.crack(contact, p);
    to.point_area.push_back(c.area(contact, p));
    push(to.point_position, point_place(c, contact, p, middle));
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
    const std::vector<FacePlace> places = places_of(s, contact);
    for (int p = 0; p < c.points_of(contact); ++p)
        add_point(c, contact, p, places[p], middle, to);
    to.areas.push_back(contact_area(c, contact));
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
