// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/forces/solid_pressure.hpp>

#include <flexpm/kernel/assembly/solid_plan.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/space/solid.hpp>
#include <flexpm/kernel/space_lanes/solid_bodies.hpp>

#include <algorithm>
#include <string>

namespace flexpm {

namespace {

int triangles(const SolidState& s) { return static_cast<int>(s.surface.side.size()); }

/// Mean displacement of a triangle.
Vector way_of(const SolidState& s, int triangle)
{
    Vector sum;
    for (int n : s.surface.nodes[triangle])
        sum = sum + space_vector(s.grains.displacement, n);
    return (1.0 / 3.0) * sum;
}

/// Make room for pressures, of which there was none.
void begin_pressures(SolidState& s)
{
    show_places(s);
    SurfaceTriangles& surface = s.surface;
    surface.pressure.assign(surface.side.size(), 0.0);
    surface.push.assign(3 * surface.side.size(), 0.0);
    surface.way.resize(3 * surface.side.size());
    for (int t = 0; t < triangles(s); ++t)
        set_space_vector(surface.way, 3 * t, way_of(s, t));
    prepare_step(s);
}

}  // namespace

void set_pressure(SolidState& s, int side, double pressure)
{
    check_not_negative("pressure", pressure, "Pa");
    const auto& sides = s.surface.side;
    if (std::find(sides.begin(), sides.end(), side) == sides.end())
        refuse("side", side, "", "has no surface; name a side of the outline");
    if (s.surface.pressure.empty()) begin_pressures(s);
    for (int t = 0; t < triangles(s); ++t)
        if (sides[t] == side) s.surface.pressure[t] = pressure;
}

bool is_pressed(const SolidState& s)
{
    const auto& pressure = s.surface.pressure;
    return std::any_of(pressure.begin(), pressure.end(), [](double p) { return p != 0.0; });
}

SidePressures side_pressures(const SolidState& s)
{
    SidePressures found;
    bool any = false;
    for (std::size_t t = 0; t < s.surface.pressure.size(); ++t) {
        const int side = s.surface.side[t];
        if (is_end(static_cast<SolidSide>(side)) || is_of_hole(side)) continue;
        const double pressure = s.surface.pressure[t];
        found.least = any ? std::min(found.least, pressure) : pressure;
        found.largest = any ? std::max(found.largest, pressure) : pressure;
        any = true;
    }
    return found;
}

void add_pressure_forces(SolidState& s, int block)
{
    const SolidPlan& plan = s.plan;
    SurfaceTriangles& surface = s.surface;
    for (int i = plan.first_pressed[block]; i < plan.first_pressed[block + 1]; ++i) {
        const int t = plan.pressed[i];
        const auto& n = surface.nodes[t];
        const Vector first = s.grains.position(n[0]);
        const Vector area =
            0.5 * cross(s.grains.position(n[1]) - first, s.grains.position(n[2]) - first);
        // what has come loose lies no more in the skin that the pressure acts on, deviation D57
        const double pressure = s.grains.loose[surface.grain[t]] ? 0.0 : surface.pressure[t];
        const Vector now = (-pressure) * area, way = way_of(s, t);
        // the pressure is even, so that each node bears a third, and the middle's way tells the
        // work
        s.plan.pressure_works[t] = 0.5
            * dot(space_vector(surface.push, 3 * t) + now, way - space_vector(surface.way, 3 * t));
        set_space_vector(surface.push, 3 * t, now);
        set_space_vector(surface.way, 3 * t, way);
        for (int node : n)
            set_space_vector(
                s.grains.force, node, space_vector(s.grains.force, node) + (1.0 / 3.0) * now);
    }
}

Vector pressure_on(const SolidState& s, int triangle)
{
    return s.surface.push.empty() ? Vector {} : space_vector(s.surface.push, 3 * triangle);
}

void sum_pressure_work(SolidState& s)
{
    for (double work : s.plan.pressure_works)
        s.ledger.pressure_work += work;
}

}  // namespace flexpm
