// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/parts/solid_plates.hpp>

#include <flexpm/kernel/assembly/solid_plan.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/forces/solid_pressure.hpp>
#include <flexpm/kernel/parts/plate_loading.hpp>
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
    p.facets.push_back(triangle);
    p.area.push_back(norm(area_vector(s, triangle)));
}

namespace {

/// A vector where a contact lies on its triangle.
Vector touched(
    const Plate& plate, int index, const Array<double>& values, const std::array<int, 3>& nodes)
{
    if (plate.shares.empty()) return middle(values, nodes);
    Vector sum;
    for (int k = 0; k < 3; ++k)
        sum = sum + corner_share(plate, index, k) * space_vector(values, nodes[k]);
    return sum;
}

void set_axes(std::vector<double>& values, int index, Vector v)
{
    values[3 * index] = v.x;
    values[3 * index + 1] = v.y;
    values[3 * index + 2] = v.z;
}

Vector along_face(const Plate& plate, int index, Vector way)
{
    const Vector normal = point_normal(plate, index);
    return way - dot(normal, way) * normal;
}

/// Force along the face on a grain that is at a way from its reference: a spring, and a slider that
/// bears friction. What slides rubs with the mean of the forces before and after.
Vector rub(Plate& plate, int index, Vector way)
{
    const double stiffness = sliding_stiffness(plate, index);
    const Vector slid = three_axes(plate.slid, index), old = three_axes(plate.shear_force, index);
    const Vector stretch = along_face(plate, index, way) - slid;
    const double most = plate.bonded
        ? std::numeric_limits<double>::infinity()
        : plate.friction * std::max(point_push(plate, index), 0.0) / stiffness;
    const double size = norm(stretch);
    const Vector stuck = size > most ? (most / size) * stretch : stretch;
    const Vector slip = stretch - stuck, force = -stiffness * stuck;
    plate.rubbed[index] -= 0.5 * dot(old + force, slip);
    set_axes(plate.slid, index, slid + slip);
    set_axes(plate.shear_force, index, force);
    return force;
}

/// Sum of the forces of a plate's contacts on the grains [N].
Vector force_of(const Plate& plate)
{
    Vector sum;
    double pushes = 0.0;
    for (int i = 0; i < static_cast<int>(plate.facets.size()); ++i) {
        if (plate.normals.empty())
            pushes += point_push(plate, i);
        else
            sum = sum + point_push(plate, i) * point_normal(plate, i);
        if (plate.friction > 0.0) sum = sum + three_axes(plate.shear_force, i);
    }
    return sum + pushes * plate.normal;
}

/// Let a plate press as the pressure has done that acts on its side, and store what that takes.
/// Deviation D93.
void take_over_pressure(SolidState& s, Plate& p)
{
    if (!is_pressed(s)) return;
    for (int i = 0; i < static_cast<int>(p.facets.size()); ++i) {
        const int triangle = p.facets[i];
        p.opening[i] = -dot(p.normal, pressure_on(s, triangle)) / point_stiffness(p, i);
        const Vector way = middle(s.grains.displacement, s.surface.nodes[triangle]);
        p.gap[i] = p.opening[i] - dot(p.normal, way);
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
    plate.rubbed.assign(plate.facets.size(), 0.0);
    plate.shear_force.assign(3 * plate.facets.size(), 0.0);
    plate.slid.assign(3 * plate.facets.size(), 0.0);
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
        const Plate all = plate;
        const auto keep = [&](const auto& from, auto& to, std::size_t width) {
            to.clear();
            for (std::size_t i = 0; width * i < from.size(); ++i)
                if (all.bonded || all.opening[i] <= 0.0)
                    to.insert(to.end(), from.begin() + width * i, from.begin() + width * (i + 1));
        };
        keep(all.facets, plate.facets, 1);
        for (auto member : { &Plate::gap, &Plate::area, &Plate::opening, &Plate::rubbed })
            keep(all.*member, plate.*member, 1);
        for (auto member :
            { &Plate::normals, &Plate::shear_force, &Plate::slid, &Plate::shares, &Plate::arms })
            keep(all.*member, plate.*member, 3);
        plate.bonded = true;
    }
    prepare_step(s);
}

void centre_position(const SolidState& s, Plate& plate)
{
    Vector sum;
    double area = 0.0;
    for (int i = 0; i < static_cast<int>(plate.facets.size()); ++i) {
        const auto& nodes = s.surface.nodes[plate.facets[i]];
        sum = sum + plate.area[i] * touched(plate, i, s.grains.reference, nodes);
        area += plate.area[i];
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
    if (p.facets.empty())
        refuse("add_end_plate: triangles of side " + std::to_string(number), 0.0, "",
            "must be above 0; give cells of a solid with bottom and top");
    p.gap.assign(p.facets.size(), 0.0);
    p.opening.assign(p.facets.size(), 0.0);
    p.position = middle(s.grains.reference, s.surface.nodes[p.facets.front()]);
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
        for (int i = 0; i < static_cast<int>(plate.facets.size()); ++i) {
            const Vector way = middle(s.grains.displacement, s.surface.nodes[plate.facets[i]]);
            set_axes(plate.slid, i, along_face(plate, i, way));
        }
    }
}

void add_plate_forces(SolidState& s, int block)
{
    const SolidPlan& plan = s.plan;
    for (int i = plan.first_press[block]; i < plan.first_press[block + 1]; ++i) {
        const PlateTouch touch = plan.presses[i];
        Plate& plate = s.plates[touch.plate];
        const auto& nodes = s.surface.nodes[plate.facets[touch.index]];
        const Vector way =
            touched(plate, touch.index, s.grains.displacement, nodes) - plate.displacement;
        const Vector normal = point_normal(plate, touch.index);
        plate.opening[touch.index] = plate.gap[touch.index] + dot(normal, way)
            - dot(point_arm(plate, touch.index), plate.turn);
        Vector force = point_push(plate, touch.index) * normal;
        if (plate.friction > 0.0) force = force + rub(plate, touch.index, way);
        for (int k = 0; k < 3; ++k) {
            const Vector part = corner_share(plate, touch.index, k) * force;
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
