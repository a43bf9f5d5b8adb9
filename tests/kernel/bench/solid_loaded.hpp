// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Cubes of polyhedral grains between a held bottom and a driven top, for counting and
/// timing steps. SI units, lengths per unit step.
#pragma once

#include <flexpm/kernel/core/random.hpp>
#include <flexpm/kernel/parts/solid_plates.hpp>
#include <flexpm/kernel/space_lanes/solid_bodies.hpp>
#include <flexpm/kernel/statics/solid_loading.hpp>
#include <flexpm/kernel/step/solid_masses.hpp>
#include <flexpm/kernel/step/solid_step.hpp>
#include <flexpm/kernel/topology/solid_build.hpp>

#include "support/specimens.hpp"

#include <vector>

namespace loaded {

constexpr double grain_size = 3e-3;  // [m]

/// So many grains along each edge, whose centres are strewn about a lattice, with scaled masses.
inline flexpm::SolidState cube(int along, bool rigid)
{
    flexpm::Random random(1);
    const auto place = [&](int k) { return grain_size * (k + 0.5 + 0.5 * (random.next() - 0.5)); };
    std::vector<flexpm::Sphere> spheres;
    for (int k = 0; k < along * along * along; ++k) {
        const double x = place(k % along), y = place(k / along % along),
                     z = place(k / along / along);
        spheres.push_back({ { x, y, z }, 0.5 * grain_size * (0.8 + 0.4 * random.next()) });
    }
    const double edge = along * grain_size;
    const auto solid = flexpm::Solid::box(edge, edge, edge);
    flexpm::SolidState s =
        flexpm::make_solid(flexpm::polyhedra(spheres, solid, { 0.1 * grain_size, false }), solid,
            { { specimens::granite() }, { specimens::granite_contact() }, {},
                flexpm::FacePointRule::corners_and_inner, rigid });
    if (rigid)
        for (const auto side : { flexpm::SolidSide::bottom, flexpm::SolidSide::top })
            flexpm::add_end_plate(s, side, false);
    flexpm::scale_masses(s, 0.7);
    return s;
}

/// Ends that move apart by `rate`, as a strain of a step, and grains that move with them.
///
/// @param torn  strain that has moved each grain as a body, so that all contacts are past their
///         strength, some slid and some opened; 0: none
inline void strain(flexpm::SolidState& s, double rate, double torn)
{
    const bool rigid = !s.bodies.empty();
    flexpm::SolidField field;
    const auto add = [&](int grain, flexpm::Vector p) {
        if (torn != 0.0) p = flexpm::space_vector(s.grains.reference, s.grains.centre(grain));
        field.ways.push_back({ -0.2 * p.x + (torn != 0.0 ? p.z : 0.0), -0.2 * p.y, p.z });
    };
    if (rigid) {
        for (int g = 0; g < s.grains.count; ++g)
            add(g, flexpm::space_vector(s.grains.reference, s.grains.centre(g)));
        field.turns.resize(s.grains.count);
        flexpm::Plate& top = s.plates[flexpm::find_plate(s, flexpm::SolidSide::top)];
        top.velocity = { 0.0, 0.0, rate * top.position.z };
    } else {
        flexpm::for_each_node(s, [&](int grain, int number) {
            add(grain, flexpm::space_vector(s.grains.reference, s.grains.node(grain, number)));
        });
        for (const auto side : { flexpm::SolidSide::bottom, flexpm::SolidSide::top })
            flexpm::prescribe(s, flexpm::side_nodes(s, side), 2, 0.0);
    }
    flexpm::begin_from(s, field, torn, rate);
}

}  // namespace loaded
