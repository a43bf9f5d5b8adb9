// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/measure/mean_stress.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/plane_lanes/rigid_grain.hpp>

#include <algorithm>
#include <cmath>

namespace flexpm {

namespace {

/// Symmetric part of the sum of forces times places, and the volume that it is a stress of.
struct Virial {
    Tensor sum { 0.0, 0.0, 0.0 };  ///< [N m]
    double volume = 0.0;           ///< [m^3]

    void add(Point force, Point place)
    {
        sum.xx += force.x * place.x;
        sum.yy += force.y * place.y;
        sum.xy += 0.5 * (force.x * place.y + force.y * place.x);
    }

    void add(const Tensor& stress, double part)
    {
        sum.xx += part * stress.xx;
        sum.yy += part * stress.yy;
        sum.xy += part * stress.xy;
        volume += part;
    }

    Tensor over(double whole) const { return { sum.xx / whole, sum.yy / whole, sum.xy / whole }; }
};

/// Triangles of a deformable grain, as deformed.
void add_triangles(const Grains& grains, int grain, Virial& total)
{
    const PlaneStiffness c = stiffness_of(grains, grain);
    for (int t = 0; t < triangles_of(grains, grain); ++t) {
        const TriangleShape shape = shape_of(grains, grain, t);
        const auto n = triangle_nodes(grains, grain, t);
        const auto u = [&](int k) { return grains.displacement_at(grains.node(grain, n[k])); };
        const Gradient h = displacement_gradient(shape, u(0), u(1), u(2));
        const double ratio = (1.0 + h.xx) * (1.0 + h.yy) - h.xy * h.yx;
        total.add(cauchy_stress(shape, c, u(0), u(1), u(2)), ratio * shape.volume);
    }
}

/// Forces on a rigid grain, which its shape carries from node to node.
void add_rigid(const Assembly& a, int grain, Virial& total)
{
    const Point centre = a.grains.point_at(a.grains.centre(grain));
    for (int n = 0; n < a.grains.nodes_of(grain); ++n) {
        const int node = a.grains.node(grain, n);
        total.add(a.grains.force_at(node), a.grains.point_at(node) - centre);
    }
    total.volume += a.volume_of(cell_section(a.grains, grain).area);
}

/// What contacts bear between the places of their two faces.
void add_contacts(const Assembly& a, Virial& total)
{
    const Contacts& contacts = a.contacts;
    for (int c = 0; c < contacts.count; ++c) {
        if (contacts.erased[c]) continue;
        for (int side = 0; side < 2; ++side) {
            for (int corner = 0; corner < contacts.corners_of(c); ++corner) {
                total.add(Point {} - contacts.force(c, side, corner),
                    a.grains.point_at(contacts.node(c, side, corner)));
            }
        }
        for (int p = 0; p < contacts.points_of(c); ++p) {
            const double gap = opening_of(contacts, c, p);
            total.volume += contacts.area(c, p) * std::min(gap, 0.0);
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

/// Calls visit(force, place) with the net force on each node, or on the centre of each rigid grain,
/// that is free to move.
template <class Visit> void for_each_net_force(const Grains& grains, Visit visit)
{
    const auto free = [&](Point force, int node) {
        if (grains.prescribed[grains.component(node, 0)]) force.x = 0.0;
        if (grains.prescribed[grains.component(node, 1)]) force.y = 0.0;
        visit(force, grains.point_at(node));
    };
    for (int g = 0; g < grains.count; ++g) {
        if (grains.erased[g]) continue;
        if (grains.is_rigid(g)) {
            free(in_plane(resultant_on(grains, g).force), grains.centre(g));
            continue;
        }
        for (int n = 0; n < grains.nodes_of(g); ++n)
            free(grains.force_at(grains.node(g, n)), grains.node(g, n));
    }
}

}  // namespace

Balance balance(const Assembly& a)
{
    Virial inside;
    for (int g = 0; g < a.grains.count; ++g) {
        if (a.grains.erased[g]) continue;
        if (a.grains.is_rigid(g))
            add_rigid(a, g, inside);
        else
            add_triangles(a.grains, g, inside);
    }
    add_contacts(a, inside);

    Balance found;
    for (const Plate& p : a.plates) {
        inside.volume -= overlap(p);
        if (!p.loaded || p.load == 0.0) continue;
        const double share = std::fabs(p.load - dot(p.normal, p.force)) / p.load;
        found.plate_share = std::max(found.plate_share, share);
    }
    if (!(inside.volume > 0.0)) return found;
    Point middle;
    int places = 0;
    for_each_net_force(a.grains, [&](Point force, Point place) {
        found.missing_force = found.missing_force + force;
        middle = middle + place;
        ++places;
    });
    Virial outside = inside;
    for_each_net_force(a.grains,
        [&](Point force, Point place) { outside.add(force, place - (1.0 / places) * middle); });
    found.mean_stress = inside.over(inside.volume);
    found.outside_stress = outside.over(inside.volume);
    return found;
}

}  // namespace flexpm
