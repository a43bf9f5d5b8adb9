// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Short runs that between them reach all of a step, for comparisons bit by bit.
#pragma once

#include <flexpm/kernel/forces/gravity.hpp>
#include <flexpm/kernel/laboratory/axial_measures.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/plane_lanes/rigid_grain.hpp>
#include <flexpm/kernel/topology/plate_build.hpp>

#include "contact_round.hpp"
#include "joint_rows.hpp"
#include "same_bits.hpp"

#include <functional>
#include <string>
#include <vector>

namespace sample_runs {

using flexpm::Assembly;
using flexpm::Point;

/// A name, and what makes the specimen and steps it to the end of the run.
struct Run {
    std::string name;
    std::function<Assembly()> end_state;
};

inline void step(Assembly& a, int steps, double damping = 0.7)
{
    flexpm::StepOptions o;
    o.damping = damping;
    for (int i = 0; i < steps; ++i) {
        o.measure = i % 10 == 0 || i + 1 == steps;
        flexpm::step(a, o);
    }
}

/// Sheared, drawn apart and pressed from the sides.
inline Assembly broken(const flexpm::AssemblyOptions& options)
{
    Assembly a = same_bits::breaking(options);
    step(a, 500);
    return a;
}

/// Two minerals, each contact of another normal, drawn over each other under high pressure: cracked
/// points slide.
inline Assembly slid(int points)
{
    flexpm::AssemblyOptions o = specimens::options();
    const specimens::Specimen s = specimens::random_grains(12e-3, 15e-3, 3e-3, 4);
    o.points = points;
    o.elastic = { specimens::granite(), specimens::granite(flexpm::Plane::strain) };
    o.laws.assign(4, specimens::granite_contact());
    o.laws[3].tensile_strength *= 0.5;
    o.laws[3].cohesion *= 0.5;
    for (int g = 0; g < static_cast<int>(s.discs.size()); ++g)
        o.grain_material.push_back(g % 2);
    for (std::size_t e = 0; e < s.cells.shared_edges.size(); ++e)
        o.edge_normal.push_back(e % 3 == 0);
    Assembly a = specimens::assemble(s, o);
    flexpm::scale_masses(a, 0.7);
    flexpm::prescribe(a, flexpm::side_nodes(a, 0), 0, 0.0);
    flexpm::prescribe(a, flexpm::side_nodes(a, 0), 1, 0.0);
    flexpm::prescribe(a, flexpm::side_nodes(a, 2), 0, 4e-7);
    for (int side : { 1, 2, 3 })
        flexpm::set_pressure(a, side, 2e7);
    step(a, 500);
    return a;
}

/// Squeezed between a rough plate below and a smooth one above, with a soft membrane of two plates.
inline Assembly squeezed(bool rigid)
{
    flexpm::AssemblyOptions o = specimens::options();
    o.rigid = rigid;
    Assembly a = specimens::assemble(specimens::random_grains(12e-3, 15e-3, 3e-3, 5), o);
    flexpm::PlateContact rough;
    rough.friction = 0.4;
    flexpm::add_side_plates(a, flexpm::bottom_side, 1, rough);
    const int top = flexpm::add_side_plates(a, flexpm::top_side, 1, {}).front();
    flexpm::set_velocity(a, top, { 0.0, rigid ? -1e-7 : -4e-7 });
    const std::vector<int> membrane = flexpm::add_side_plates(a, 1, 2, {});
    flexpm::scale_masses(a, 0.7);
    for (int plate : membrane)
        flexpm::press(a, plate, 1e5);
    flexpm::set_gravity(a, { 1e-12, -1e-11 });
    step(a, 500);
    return a;
}

/// The upper row of a grid of rigid grains is torn off and thrown back askew: its bonds end, its
/// discs touch those below and roll.
inline Assembly thrown()
{
    flexpm::AssemblyOptions o = specimens::options();
    o.rigid = true;
    Assembly a = specimens::assemble(specimens::grid(5, 3, 3e-3), o);
    flexpm::scale_masses(a, 0.0);
    for (const Point way : { Point { 0.0, 1e-6 }, Point { 1e-6, -1e-6 } }) {
        for (int g = 10; g < 15; ++g)
            flexpm::set_motion(a.grains, g, way, 1e-5 * g, 1.0);
        for (int i = 0; i < 20; ++i) {
            step(a, 10, 0.0);
            contact_round::update_contacts(a);
        }
    }
    return a;
}

/// Two rows pressed on each other and thrown along their joint by more than a grain.
inline Assembly slid_far(bool rigid)
{
    flexpm::ContactMaterial weak = joint_rows::smooth_joint();
    weak.cohesion = weak.tensile_strength = 1e4;
    Assembly a = joint_rows::two_rows(rigid, 3, weak);
    flexpm::scale_masses(a, 0.0);
    for (int side : { flexpm::bottom_side, flexpm::top_side })
        flexpm::set_pressure(a, side, 1e6);
    for (int g = joint_rows::columns; g < 2 * joint_rows::columns; ++g)
        driven::set_velocity(a, g, Point { 1e-5, 0.0 });
    for (int i = 0; i < 50; ++i) {
        step(a, 10, 0.0);
        contact_round::update_contacts(a);
    }
    return a;
}

inline std::vector<Run> all()
{
    std::vector<Run> runs;
    for (int points : { 1, 2, 3 }) {
        flexpm::AssemblyOptions o = specimens::options();
        o.points = points;
        const std::string with = " with " + std::to_string(points) + " points";
        runs.push_back({ "refined grains" + with, [o] { return broken(o); } });
        o.mesh = flexpm::MeshKind::fan;
        runs.push_back({ "fans" + with, [o] { return broken(o); } });
        runs.push_back({ "two minerals" + with, [points] { return slid(points); } });
    }
    runs.push_back({ "grains between plates", [] { return squeezed(false); } });
    runs.push_back({ "rigid grains between plates", [] { return squeezed(true); } });
    runs.push_back({ "rigid grains that touch", thrown });
    runs.push_back({ "faces that slide", [] { return slid_far(false); } });
    runs.push_back({ "rigid faces that slide", [] { return slid_far(true); } });
    return runs;
}

}  // namespace sample_runs
