// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/parts/solid_plates.hpp>

#include <flexpm/kernel/assembly/solid_plan.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/forces/solid_pressure.hpp>
#include <flexpm/kernel/parts/plate_loading.hpp>
#include <flexpm/kernel/parts/surface_pieces.hpp>
#include <flexpm/kernel/space_lanes/solid_access.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace flexpm {

Vector middle(const Array<double>& values, const std::array<int, 3>& nodes)
{
    return (1.0 / 3.0)
        * (space_vector(values, nodes[0]) + space_vector(values, nodes[1])
            + space_vector(values, nodes[2]));
}

void add_contact(const SolidState& s, Plate& p, int triangle)
{
    add_touch(s, p, triangle, { 1.0, { 1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0 }, {} });
    p.points.back().whole = true;
}

namespace {

/// A vector where a contact lies on its triangle.
Vector touched(
    const PlatePoint& point, const Array<double>& values, const std::array<int, 3>& nodes)
{
    if (point.whole) return middle(values, nodes);
    Vector sum;
    for (int k = 0; k < 3; ++k)
        sum = sum + point.weights[k] * space_vector(values, nodes[k]);
    return sum;
}

Vector along_face(Vector normal, Vector way) { return way - dot(normal, way) * normal; }

/// Force along the face on a grain that is at a way from its reference: a spring, and a slider that
/// bears friction. What slides rubs with the mean of the forces before and after.
Vector rub(Plate& plate, int index, Vector way)
{
    const double stiffness = sliding_stiffness(plate, index);
    PlatePoint& point = plate.points[index];
    const Vector old = point_shear(plate, index);
    const Vector stretch = along_face(point.normal, way) - point.slip;
    const double most = plate.bonded
        ? std::numeric_limits<double>::infinity()
        : plate.friction * std::max(point_push(plate, index), 0.0) / stiffness;
    const double size = norm(stretch);
    const Vector stuck = size > most ? (most / size) * stretch : stretch;
    const Vector slip = stretch - stuck, force = -stiffness * stuck;
    point.friction_energy -= 0.5 * dot(old + force, slip);
    point.slip = point.slip + slip;
    const auto [first, second] = face_axes(point.normal);
    point.shear = { dot(first, force), dot(second, force) };
    return force;
}

/// Sum of the forces of a plate's contacts on the grains [N].
Vector force_of(const Plate& plate)
{
    Vector sum;
    double pushes = 0.0;
    for (int i = 0; i < plate_points(plate); ++i) {
        if (is_jaw(plate))
            sum = sum + point_push(plate, i) * point_normal(plate, i);
        else
            pushes += point_push(plate, i);
        if (plate.friction > 0.0) sum = sum + point_shear(plate, i);
    }
    return sum + pushes * plate.normal;
}

double friction_energy(const Plate& plate)
{
    double sum = 0.0;
    for (const PlatePoint& point : plate.points)
        sum += point.friction_energy;
    return sum;
}

/// Let a plate press as the pressure has done that acts on its side, and store what that takes.
/// Deviation D93.
void take_over_pressure(SolidState& s, Plate& p)
{
    if (!is_pressed(s)) return;
    for (int i = 0; i < plate_points(p); ++i) {
        PlatePoint& point = p.points[i];
        point.opening = -dot(p.normal, pressure_on(s, point.facet)) / point_stiffness(p, i);
        const Vector way = middle(s.grains.displacement, s.surface.nodes[point.facet]);
        point.gap = point.opening - dot(p.normal, way);
    }
    s.ledger.initial += elastic_energy(p);
}

/// Work on the specimen of a plate that is driven, over a step after which its force is known [J].
/// @param before  force at its beginning [N]
double work_of_step(const Plate& plate, Vector before, double dt)
{
    const Vector force = 0.5 * (before + plate.force);
    const double work = dt * dot(force, plate.velocity);
    if (!(plate.machine_stiffness > 0.0)) return work;
    const double give = plate.machine_give - dot(plate.normal, before) / plate.machine_stiffness;
    return work - give * dot(force, plate.normal);
}

}  // namespace

void roughen(Plate& plate, double friction)
{
    plate.friction = friction;
    for (PlatePoint& point : plate.points) {
        point.shear = {};
        point.slip = {};
        point.friction_energy = 0.0;
    }
}

void lay_strip(Plate& plate, double strip)
{
    check_not_negative("stiffness of a strip", strip, "Pa/m");
    if (strip == 0.0) return;
    plate.strip = strip;
    const double in_series = 1.0 / (1.0 / plate.stiffness + 1.0 / strip);
    plate.shear_stiffness *= in_series / plate.stiffness;
    plate.stiffness = in_series;
}

int add_plate(SolidState& s, const Plate& plate)
{
    s.plates.push_back(plate);
    prepare_step(s);
    return static_cast<int>(s.plates.size()) - 1;
}

void hold_touching(SolidState& s)
{
    for (Plate& plate : s.plates) {
        const auto is_off = [&](const PlatePoint& point) {
            return !plate.bonded && point.opening > 0.0;
        };
        plate.points.erase(
            std::remove_if(plate.points.begin(), plate.points.end(), is_off), plate.points.end());
        plate.bonded = true;
    }
    prepare_step(s);
}

void centre_position(const SolidState& s, Plate& plate)
{
    Vector sum;
    double area = 0.0;
    for (const PlatePoint& point : plate.points) {
        const auto& nodes = s.surface.nodes[point.facet];
        sum = sum + point.area * touched(point, s.grains.reference, nodes);
        area += point.area;
    }
    const Vector way = (1.0 / area) * sum - plate.position;
    plate.position = plate.position + (way - dot(plate.normal, way) * plate.normal);
}

Plate plain_plate(const SolidState& s, SolidSide side)
{
    Plate p;
    p.side = static_cast<int>(side);
    p.normal = { 0.0, 0.0, side == SolidSide::bottom ? 1.0 : -1.0 };
    p.stiffness = grain_mean(s.grains, [&](int g) { return own_law(s, g).normal_stiffness; });
    p.shear_stiffness = grain_mean(s.grains, [&](int g) { return own_law(s, g).shear_stiffness; });
    return p;
}

void add_end_plate(SolidState& s, SolidSide side, bool bonded)
{
    const int number = static_cast<int>(side);
    if (!is_end(side))
        refuse("add_end_plate: side", number, "", "must be 0, the bottom, or 2, the top");
    if (find_plate(s, side) >= 0)
        refuse("add_end_plate: side", number, "", "must be without a plate; it has one");
    Plate p = plain_plate(s, side);
    p.bonded = bonded;
    for (int t = 0; t < static_cast<int>(s.surface.side.size()); ++t)
        if (s.surface.side[t] == number) add_contact(s, p, t);
    if (p.points.empty())
        refuse("add_end_plate: triangles of side " + std::to_string(number), 0.0, "",
            "must be above 0; give cells of a solid with bottom and top");
    p.position = middle(s.grains.reference, s.surface.nodes[p.points.front().facet]);
    centre_position(s, p);
    take_over_pressure(s, p);
    s.plates.push_back(p);
    prepare_step(s);
}

void roughen_plates(SolidState& s, double friction)
{
    check_not_negative("friction of plates", friction, "");
    if (s.plates.size() != 2 || s.plates.front().bonded) {
        refuse("plates with friction", static_cast<double>(s.plates.size()), "",
            "must be 2 that press; roughen the ends before a pressure acts");
    }
    for (Plate& plate : s.plates) {
        roughen(plate, friction);
        for (PlatePoint& point : plate.points) {
            const Vector way = middle(s.grains.displacement, s.surface.nodes[point.facet]);
            point.slip = along_face(point.normal, way);
        }
    }
}

void add_plate_forces(SolidState& s, int block)
{
    const SolidPlan& plan = s.plan;
    for (int i = plan.first_press[block]; i < plan.first_press[block + 1]; ++i) {
        const PlateTouch touch = plan.presses[i];
        Plate& plate = s.plates[touch.plate];
        PlatePoint& point = plate.points[touch.index];
        const auto& nodes = s.surface.nodes[point.facet];
        const Vector way = touched(point, s.grains.displacement, nodes) - plate.displacement;
        point.opening = gap_after(plate, touch.index, way);
        Vector force = point_push(plate, touch.index) * point.normal;
        if (plate.friction > 0.0) force = force + rub(plate, touch.index, way);
        for (int k = 0; k < 3; ++k) {
            const Vector part = point.weights[k] * force;
            set_space_vector(
                s.grains.force, nodes[k], space_vector(s.grains.force, nodes[k]) + part);
        }
    }
}

void sum_plates(SolidState& s, double dt, double damping)
{
    for (std::size_t number = 0; number < s.plates.size(); ++number) {
        Plate& plate = s.plates[number];
        const Vector before = plate.force;
        plate.force = force_of(plate);
        if (plate.friction > 0.0) plate.friction_energy = friction_energy(plate);
        if (plate.loaded) {
            if (plate.machine_stiffness > 0.0)
                plate.machine_give = dot(plate.normal, plate.force) / plate.machine_stiffness;
            if (dt > 0.0) integrate_loaded(s, number, s.surface.grain, dt, damping);
            continue;
        }
        if (dt > 0.0) plate.boundary_work += work_of_step(plate, before, dt);
    }
}

}  // namespace flexpm
