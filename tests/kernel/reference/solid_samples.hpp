// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Bricks and packings for the plain step of solids, and what their tests ask of them.
#pragma once

#include "reference/plain_solid.hpp"
#include "support/specimens.hpp"
#include "support/sphere_samples.hpp"

#include <cmath>

namespace solid_samples {

using namespace plain_solid;
using flexpm::cross;
using flexpm::dot;
using flexpm::norm;
using flexpm::Quaternion;

constexpr double side = 3e-3;  ///< of a cubic grain [m]

/// Cubic grains, so many along each axis.
inline flexpm::Polyhedra brick(int nx, int ny, int nz)
{
    std::vector<flexpm::Sphere> spheres;
    for (int z = 0; z < nz; ++z)
        for (int y = 0; y < ny; ++y)
            for (int x = 0; x < nx; ++x)
                spheres.push_back(
                    { { side * (x + 0.5), side * (y + 0.5), side * (z + 0.5) }, 0.5 * side });
    return flexpm::polyhedra(
        spheres, flexpm::Solid::box(side * nx, side * ny, side * nz), { 0.1 * side, false });
}

/// Grains of a random packing in a cube.
inline flexpm::Polyhedra packing(int grains, std::uint64_t seed)
{
    const double edge = side * std::cbrt(0.6 * grains);
    const auto solid = flexpm::Solid::box(edge, edge, edge);
    return flexpm::polyhedra(
        flexpm_test::packed_spheres(solid, grains, seed), solid, { 0.1 * side, false });
}

/// Motion of a body: a turn about a point, then a way.
struct Motion {
    Quaternion turn;
    Vector about, way;
};

/// Move a grain as a body on from where it is.
inline void move(Specimen& s, int grain, const Motion& m)
{
    Grain& g = s.grains[grain];
    for (int n : g.nodes) {
        Node& node = s.nodes[n];
        node.displacement =
            node.displacement + flexpm::turned_by(m.turn, node.place() - m.about) + m.way;
    }
    if (!g.is_rigid()) return;
    g.turn = normalized(m.turn * g.turn);
    follow(s);
}

inline void move_all(Specimen& s, const Motion& m)
{
    for (std::size_t g = 0; g < s.grains.size(); ++g)
        move(s, static_cast<int>(g), m);
}

/// Force on a grain and moment about the origin of its nodes' forces.
struct Resultant {
    Vector force, moment;
    double largest = 0.0;  ///< force on a node [N]
};

inline Resultant resultant(const Specimen& s, const std::vector<int>& nodes)
{
    Resultant r;
    for (int n : nodes) {
        const Node& node = s.nodes[n];
        r.force = r.force + node.force;
        r.moment = r.moment + cross(node.place(), node.force);
        r.largest = std::max(r.largest, norm(node.force));
    }
    return r;
}

/// All nodes that have a force of their own, and moments of rigid grains.
inline Resultant resultant(const Specimen& s)
{
    Resultant sum;
    for (const Grain& g : s.grains) {
        const std::vector<int> centre { g.centre() };
        const Resultant r = resultant(s, g.is_rigid() ? centre : g.nodes);
        sum.force = sum.force + r.force;
        sum.moment = sum.moment + r.moment + (g.is_rigid() ? g.moment : Vector {});
        sum.largest = std::max(sum.largest, r.largest);
    }
    return sum;
}

/// Sums over all contact points [J].
inline double sum_over_points(const Specimen& s, double flexpm::FacePointState::*energy)
{
    double sum = 0.0;
    for (const Contact& c : s.contacts)
        for (const ContactPoint& p : c.points)
            sum += p.area * (p.state.*energy);
    return sum;
}

inline double damage_energy(const Specimen& s)
{
    return sum_over_points(s, &flexpm::FacePointState::damage_energy);
}

inline double friction_energy(const Specimen& s)
{
    return sum_over_points(s, &flexpm::FacePointState::friction_energy);
}

inline int cracked_points(const Specimen& s)
{
    int count = 0;
    for (const Contact& c : s.contacts)
        for (const ContactPoint& p : c.points)
            count += p.traction.damage >= 1.0;
    return count;
}

/// Vector drawn from a cube of edge 1 about the origin.
inline Vector draw(flexpm::Random& random)
{
    const double x = random.next() - 0.5, y = random.next() - 0.5, z = random.next() - 0.5;
    return { x, y, z };
}

/// Grains that fly apart and turn.
inline void kick(Specimen& s, double speed, double spin, std::uint64_t seed)
{
    flexpm::Random random(seed);
    for (Grain& g : s.grains) {
        const Vector v = speed * draw(random), w = spin * draw(random);
        const Vector centre = s.nodes[g.centre()].reference;
        for (int n : g.nodes)
            s.nodes[n].velocity = v + cross(w, s.nodes[n].reference - centre);
        g.spin = w;
        g.angular_momentum = g.inertia * w;
    }
}

}  // namespace solid_samples
