// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/measure/solid_balance.hpp>

#include <flexpm/kernel/space_lanes/solid_access.hpp>
#include <flexpm/kernel/space_lanes/tetrahedron_forces.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace flexpm {

namespace {

/// Symmetric part of the sum of forces times places, and the volume that it is a stress of.
struct Virial {
    SpaceTensor sum {};   ///< [N m]
    double volume = 0.0;  ///< [m^3]

    void add(Vector f, Vector r)
    {
        sum.xx += f.x * r.x;
        sum.yy += f.y * r.y;
        sum.zz += f.z * r.z;
        sum.yz += 0.5 * (f.y * r.z + f.z * r.y);
        sum.xz += 0.5 * (f.x * r.z + f.z * r.x);
        sum.xy += 0.5 * (f.x * r.y + f.y * r.x);
    }

    void add(const SpaceTensor& stress, double part)
    {
        sum.xx += part * stress.xx;
        sum.yy += part * stress.yy;
        sum.zz += part * stress.zz;
        sum.yz += part * stress.yz;
        sum.xz += part * stress.xz;
        sum.xy += part * stress.xy;
        volume += part;
    }

    SpaceTensor over(double v) const
    {
        return { sum.xx / v, sum.yy / v, sum.zz / v, sum.yz / v, sum.xz / v, sum.xy / v };
    }
};

/// Tetrahedra of a grain, as deformed; of a rigid one their volume alone.
void add_tetrahedra(const SolidState& s, int grain, Virial& total)
{
    const int block = s.grains.block_of(grain);
    const auto c = load_rows<PlaneStiffness>(
        &s.grains.stiffness[block * row_count<PlaneStiffness> * lanes], 0);
    const bool rigid = s.grains.is_rigid(grain);
    for_each_tetrahedron(s, block, [&](const TetrahedronShape& t, std::array<int, 4> n) {
        if (rigid) {
            total.volume += t.volume;
            return;
        }
        const Vector first = s.grains.position(n[0]);
        const double volume =
            triple(s.grains.position(n[1]) - first, s.grains.position(n[2]) - first,
                s.grains.position(n[3]) - first)
            / 6.0;
        const auto way = [&](int k) { return space_vector(s.grains.displacement, n[k]); };
        total.add(cauchy_stress(t, c, way(0), way(1), way(2), way(3)), volume);
    });
}

/// Forces on a rigid grain, which its shape carries from node to node.
void add_rigid(const SolidState& s, int grain, Virial& total)
{
    const Vector centre = s.grains.position(s.grains.centre(grain));
    for (int n = 0; n < s.grains.vertices_of(grain); ++n) {
        const int node = s.grains.node(grain, n);
        total.add(space_vector(s.grains.force, node), s.grains.position(node) - centre);
    }
}

/// What contacts bear between the places of their two faces, and the volume of their overlaps.
void add_contacts(const SolidState& s, Virial& total)
{
    const FaceContacts& c = s.contacts;
    for (int contact = 0; contact < c.count; ++contact) {
        const std::vector<FacePlace> places = places_of(s, contact);
        const std::vector<Vector> forces = point_forces(s, contact);
        for (int p = 0; p < c.points_of(contact); ++p) {
            if (!(c.area(contact, p) > 0.0)) continue;
            const Vector force = forces[p];
            for (int k = 0; k < c.corners_of(contact); ++k)
                total.add(c.share(contact, p, k) * force,
                    s.grains.position(c.node(contact, 0, k))
                        - s.grains.position(c.node(contact, 1, k)));
            total.volume += c.area(contact, p) * std::min(places[p].opening, 0.0);
        }
    }
}

/// Overlaps of plates, which no contact of grains takes off their volume.
double overlap(const Plate& plate)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < plate.opening.size(); ++i)
        sum += plate.area[i] * std::max(-plate.opening[i], 0.0);
    return sum;
}

struct NetForce {
    Vector force, place;
};

/// Net force on each node, or on the centre of each rigid grain, as far as it is free to move.
std::vector<NetForce> net_forces(const SolidState& s)
{
    const Grains& grains = s.grains;
    std::vector<NetForce> found;
    const auto add = [&](int node, Vector force) {
        const auto held = [&](int axis) { return grains.prescribed[grains.component(node, axis)]; };
        found.push_back(
            { { held(0) ? 0.0 : force.x, held(1) ? 0.0 : force.y, held(2) ? 0.0 : force.z },
                s.grains.position(node) });
    };
    for (int g = 0; g < grains.count; ++g) {
        if (!grains.is_rigid(g)) {
            for (int n = 0; n < grains.nodes_of(g); ++n)
                add(grains.node(g, n), space_vector(grains.force, grains.node(g, n)));
            continue;
        }
        Vector force;
        for (int n = 0; n < grains.vertices_of(g); ++n)
            force = force + space_vector(grains.force, grains.node(g, n));
        add(grains.centre(g), force);
    }
    return found;
}

}  // namespace

SolidBalance balance(const SolidState& s)
{
    Virial inside;
    for (int g = 0; g < s.grains.count; ++g) {
        add_tetrahedra(s, g, inside);
        if (s.grains.is_rigid(g)) add_rigid(s, g, inside);
    }
    add_contacts(s, inside);
    SolidBalance found;
    for (const Plate& p : s.plates) {
        inside.volume -= overlap(p);
        if (!(p.loaded && p.load > 0.0)) continue;
        const double share = std::fabs(p.load - dot(p.normal, p.force)) / p.load;
        found.plate_share = std::max(found.plate_share, share);
    }
    if (!(inside.volume > 0.0)) return found;
    const std::vector<NetForce> net = net_forces(s);
    Vector middle;
    for (const NetForce& one : net) {
        found.missing_force = found.missing_force + one.force;
        middle = middle + (1.0 / static_cast<double>(net.size())) * one.place;
    }
    Virial outside = inside;
    for (const NetForce& one : net)
        outside.add(one.force, one.place - middle);
    found.mean_stress = inside.over(inside.volume);
    found.outside_stress = outside.over(inside.volume);
    return found;
}

}  // namespace flexpm
