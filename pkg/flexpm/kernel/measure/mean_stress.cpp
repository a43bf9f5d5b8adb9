// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/measure/mean_stress.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/measure/grain_stress.hpp>
#include <flexpm/kernel/plane_lanes/rigid_grain.hpp>
#include <flexpm/kernel/space_lanes/solid_access.hpp>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

namespace flexpm {

namespace {

/// Symmetric part of the sum of forces times places, and the volume that it is a stress of.
struct Virial {
    SpaceTensor sum {};   ///< [N m]
    double volume = 0.0;  ///< [m^3]

    void add(Vector force, Vector place) { sum = sum_of(sum, 1.0, product_of(force, place)); }

    void add(const SpaceTensor& stress, double part)
    {
        sum = sum_of(sum, part, stress);
        volume += part;
    }

    SpaceTensor over(double v) const
    {
        return { sum.xx / v, sum.yy / v, sum.zz / v, sum.yz / v, sum.xz / v, sum.xy / v };
    }
};

/// Forces of contacts between the places of their two faces, and the volume of their overlaps.
void add_contacts(const Assembly& a, Virial& total)
{
    const Contacts& contacts = a.contacts;
    for (int c = 0; c < contacts.count; ++c) {
        if (contacts.erased[c]) continue;
        for (int side = 0; side < 2; ++side) {
            for (int corner = 0; corner < contacts.corners_of(c); ++corner) {
                total.add(Point {} - contacts.force(c, side, corner),
                    a.grains.position(contacts.node(c, side, corner)));
            }
        }
        for (int p = 0; p < contacts.points_of(c); ++p) {
            const double gap = opening_of(contacts, c, p);
            total.volume += contacts.area(c, p) * std::min(gap, 0.0);
        }
    }
}

void add_faces(const SolidState& s, Virial& total)
{
    const FaceContacts& c = s.contacts;
    for (int contact = 0; contact < c.count; ++contact) {
        const std::vector<FacePlace> places = places_of(s, contact);
        const std::vector<Vector> forces = point_forces(s, contact);
        for (int p = 0; p < c.points_of(contact); ++p) {
            if (!(c.area(contact, p) > 0.0) || c.has_ended(contact)) continue;
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
    for (const PlatePoint& point : plate.points)
        sum += point.area * std::max(-point.opening, 0.0);
    return sum;
}

struct NetForce {
    Vector force, place;
};

/// Net force on each node, or on the centre of each rigid grain, as far as it is free to move.
std::vector<NetForce> net_forces(const Grains& grains)
{
    std::vector<NetForce> found;
    const auto add = [&](Vector force, int node) {
        const auto held = [&](int axis) { return grains.prescribed[grains.component(node, axis)]; };
        if (held(0)) force.x = 0.0;
        if (held(1)) force.y = 0.0;
        if (grains.layout.dimension == 3 && held(2)) force.z = 0.0;
        found.push_back({ force, grains.position(node) });
    };
    for (int g = 0; g < grains.count; ++g) {
        if (grains.erased[g]) continue;
        if (grains.is_rigid(g)) {
            add(resultant_on(grains, g).force, grains.centre(g));
            continue;
        }
        for (int n = 0; n < grains.nodes_of(g); ++n)
            add(grains.vector(grains.force, grains.node(g, n)), grains.node(g, n));
    }
    return found;
}

/// Mean place of the nodes. The sum is divided in 2D, its terms in 3D: the last digits may differ.
Vector middle_of(const Grains& grains, const std::vector<NetForce>& net)
{
    const double part = 1.0 / static_cast<double>(net.size());
    const bool plane = grains.layout.dimension == 2;
    Vector sum;
    for (const NetForce& one : net)
        sum = sum + (plane ? 1.0 : part) * one.place;
    return plane ? part * sum : sum;
}

}  // namespace

template <class State> Balance balance(const State& s)
{
    Virial inside;
    for (int g = 0; g < s.grains.count; ++g) {
        if (s.grains.erased[g]) continue;
        for_each_element(
            s, g, [&](const auto& element) { inside.add(element.stress, element.present_volume); });
        if (!s.grains.is_rigid(g)) continue;
        // forces on a rigid grain, which its shape carries from corner to corner
        for_each_corner_force(
            s.grains, node_forces(s), g, [&](Vector force, Vector arm) { inside.add(force, arm); });
        if constexpr (std::is_same_v<State, Assembly>)
            inside.volume += s.volume_of(cell_section(s.grains, g).area);
    }
    if constexpr (std::is_same_v<State, Assembly>)
        add_contacts(s, inside);
    else
        add_faces(s, inside);

    Balance found;
    for (const Plate& p : s.plates) {
        inside.volume -= overlap(p);
        if (!(p.loaded && p.load > 0.0)) continue;
        const double share = std::fabs(p.load - dot(p.normal, p.force)) / p.load;
        found.plate_share = std::max(found.plate_share, share);
    }
    if (!(inside.volume > 0.0)) return found;
    const std::vector<NetForce> net = net_forces(s.grains);
    const Vector middle = middle_of(s.grains, net);
    Virial outside = inside;
    for (const NetForce& one : net) {
        found.missing_force = found.missing_force + one.force;
        outside.add(one.force, one.place - middle);
    }
    found.mean_stress = inside.over(inside.volume);
    found.outside_stress = outside.over(inside.volume);
    return found;
}

template Balance balance(const Assembly&);
template Balance balance(const SolidState&);

}  // namespace flexpm
