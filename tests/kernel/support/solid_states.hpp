// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Specimens in space for the tests of their step, and the same as plain ones.
#pragma once

#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/space_lanes/solid_access.hpp>
#include <flexpm/kernel/space_lanes/solid_bodies.hpp>
#include <flexpm/kernel/statics/solid_loading.hpp>
#include <flexpm/kernel/step/solid_masses.hpp>
#include <flexpm/kernel/step/solid_step.hpp>
#include <flexpm/kernel/topology/solid_build.hpp>

#include "reference/solid_samples.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace solid_states {

using namespace flexpm;

/// Cells of a random packing in a cube, and the cube.
struct Packing {
    Solid solid;
    Polyhedra cells;
};

inline Packing packing(int grains, std::uint64_t seed)
{
    const double edge = solid_samples::side * std::cbrt(0.6 * grains);
    const auto solid = Solid::box(edge, edge, edge);
    return { solid, solid_samples::packing(grains, seed) };
}

/// A random box twice as high as wide.
inline Packing box(int grains, std::uint64_t seed)
{
    const double edge = solid_samples::side * std::cbrt(0.3 * grains);
    const auto solid = Solid::box(edge, edge, 2.0 * edge);
    return { solid,
        polyhedra(flexpm_test::packed_spheres(solid, grains, seed), solid,
            { 0.1 * solid_samples::side, false }) };
}

/// A random disc, of six grains across and three of depth.
inline Packing disc()
{
    const double side = solid_samples::side;
    const Solid solid = Solid::disc(6.0 * side, 3.0 * side, side);
    return { solid,
        polyhedra(flexpm_test::packed_spheres(solid, 120, 3), solid, { 0.1 * side, false }) };
}

inline SolidInput granite(FacePointRule rule = FacePointRule::corners_and_inner, bool rigid = false)
{
    return { { specimens::granite() }, { specimens::granite_contact() }, {}, rule, rigid };
}

/// Call visit(node of the state, node of the plain specimen) for all nodes.
template <class Visit> void for_both(const SolidState& s, plain_solid::Specimen& plain, Visit visit)
{
    for_each_node(s, [&](int grain, int number) {
        visit(s.grains.node(grain, number), plain.nodes[plain.grains[grain].nodes[number]]);
    });
}

/// Mean strain of the whole specimen along an axis, by Gauss's theorem; of rigid grains that of
/// their centres.
inline double mean_strain(const SolidState& s, double Vector::*axis)
{
    double way = 0.0, whole = 0.0;
    for (std::size_t t = 0; t < s.surface.side.size(); ++t) {
        const double area = area_vector(s, static_cast<int>(t)).*axis;
        std::array<int, 3> nodes = s.surface.nodes[t];
        if (!s.bodies.empty()) nodes.fill(s.grains.centre(s.surface.grain[t]));
        for (int n : nodes) {
            way += area * (space_vector(s.grains.displacement, n).*axis) / 3.0;
            whole += area * (space_vector(s.grains.reference, n).*axis) / 3.0;
        }
    }
    return way / whole;
}

/// Give the state what the plain specimen has: masses, places, velocities, spins, what is held.
inline void copy_motion(SolidState& s, plain_solid::Specimen& plain)
{
    for_both(s, plain, [&](int node, plain_solid::Node& n) {
        s.grains.inverse_mass[s.grains.scalar_index(node)] = n.mass > 0.0 ? 1.0 / n.mass : 0.0;
        set_space_vector(s.grains.displacement, node, n.displacement);
        set_space_vector(s.grains.velocity, node, n.velocity);
        for (int axis = 0; axis < 3; ++axis)
            s.grains.prescribed[s.grains.component(node, axis)] = n.held[axis];
    });
    for (std::size_t g = 0; g < s.bodies.size(); ++g) {
        s.bodies[g].inertia = plain.grains[g].inertia;
        set_spin(s, static_cast<int>(g), plain.grains[g].spin, plain.grains[g].spin_held);
    }
}

/// Largest difference of a vector of the nodes, relative to the largest one.
template <class Plain>
double difference(
    const SolidState& s, plain_solid::Specimen& plain, const Array<double>& values, Plain of_plain)
{
    double worst = 0.0, largest = 0.0;
    for_both(s, plain, [&](int node, plain_solid::Node& n) {
        worst = std::max(worst, norm(space_vector(values, node) - of_plain(n)));
        largest = std::max(largest, norm(of_plain(n)));
    });
    return largest > 0.0 ? worst / largest : worst;
}

}  // namespace solid_states
