// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Plates against facets.
#include <flexpm/kernel/parts/plate_contact.hpp>

#include <flexpm/kernel/assembly/loose_groups.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/parts/soft_plate.hpp>
#include <flexpm/kernel/parts/loaded_plate.hpp>

#include <algorithm>
#include <cmath>

namespace flexpm {

namespace {

void add_force(Facets& facets, const PlatePoint& p, Vector force)
{
    const Point on_grain = in_plane(force);
    const auto parts = facet_parts(p.weight);
    for (int n = 0; n < facet_nodes; ++n) {
        const int at = Facets::force_index(p.facet, FacetRow::of_plates, n);
        set_vector(facets.forces, at, vector_at(facets.forces, at) + parts[n] * on_grain);
    }
}

/// Shear force after a slip of the grain along the plate [m], within friction; what rubs off counts
/// as energy of friction.
double shear_force(Plate& plate, const PlatePoint& p, int index, double normal_force, double slip)
{
    const double old = plate.shear_force[index], trial = old - p.shear_stiffness * slip;
    const double next = within_friction(plate, normal_force, trial);
    plate.friction_energy += 0.5 * (old + next) * (trial - next) / p.shear_stiffness;
    return next;
}

/// Contact forces at the end of a step that began at the present displacements of the nodes.
///
/// @param give  of the plate, beside its velocity, against its normal [m]
Vector touch(Assembly& a, Plate& plate, double give, double dt)
{
    Vector total;
    for (int i = 0; i < plate_points(plate); ++i) {
        const PlatePoint p = plate_point(plate, i);
        const Vector along = point_normal(plate, i), tangent = tangent_of(in_plane(along));
        const auto nodes = a.facets.nodes(p.facet);
        const Point u = vector_on_edge(a.grains.displacement, nodes, p.weight);
        const Point v = vector_on_edge(a.grains.velocity, nodes, p.weight);
        const Vector way = u + dt * v - plate.displacement;
        double gap = plate.gap[i] + dot(along, way);
        if (plate.seated) gap -= plate.arms[i] * plate.turn.z;
        plate.opening[i] = gap;
        const double normal = normal_force(plate, p, gap);
        if (plate.friction > 0.0) {
            double slip = dot(tangent, dt * (v - plate.velocity));
            // a straight plate gives square to its face
            if (!plate.normals.empty()) slip += give * dot(tangent, plate.normal);
            plate.shear_force[i] = shear_force(plate, p, i, normal, slip);
        }
        const double shear = plate.shear_force[i];
        const Vector force = normal * along + shear * tangent;
        add_force(a.facets, p, force);
        total = total + force;
    }
    return total;
}

void update_plate(Assembly& a, std::size_t number, double dt, double damping)
{
    Plate& plate = a.plates[number];
    const Vector before = plate.force, from = plate.displacement;
    const bool machine = plate.machine_stiffness > 0.0;
    plate.displacement = plate.displacement + dt * plate.velocity;
    const double give = plate.seated || (machine && !plate.loaded) ? give_way(a, plate, dt) : 0.0;
    plate.force = touch(a, plate, give, dt);
    if (machine && plate.loaded)
        plate.machine_give = dot(plate.normal, plate.force) / plate.machine_stiffness;
    if (plate.loaded) {
        const double undamped = dot(plate.normal, a.loading.of_plate(number).velocity);
        integrate_loaded(plate, undamped, bears_any(plate, a.facets.grain, a.grains), dt, damping);
    } else if (machine) {
        plate.boundary_work += dot(0.5 * (before + plate.force), plate.displacement - from);
    } else {
        plate.boundary_work += dt * dot(0.5 * (before + plate.force), plate.velocity);
    }
}

}  // namespace

void require_plate(const Assembly& a, int plate)
{
    if (plate < 0 || plate >= static_cast<int>(a.plates.size())) {
        refuse("plate", plate, "", "must be the number of a plate; add one first");
    }
}

void press(Assembly& a, int plate, double pressure)
{
    require_plate(a, plate);
    check_not_negative("pressure on a plate", pressure, "Pa");
    if (a.plates[plate].mass <= 0.0) {
        refuse("mass of a plate", a.plates[plate].mass, "kg", "must be above 0; scale the masses");
    }
    a.plates[plate].loaded = true;
    a.plates[plate].load = a.area_of(pressure * a.plates[plate].width);
}

void set_velocity(Assembly& a, int plate, Vector velocity)
{
    require_plate(a, plate);
    check_finite("velocity of a plate", velocity.x, "m/s");
    check_finite("velocity of a plate", velocity.y, "m/s");
    check_finite("velocity of a plate", velocity.z, "m/s");
    Plate& p = a.plates[plate];
    let_go(p);
    p.velocity = velocity;
}

void set_machine(Assembly& a, int plate, double stiffness)
{
    require_plate(a, plate);
    check_positive("stiffness of a machine", stiffness, "N/m");
    Plate& p = a.plates[plate];
    if (p.machine_stiffness > 0.0) {
        refuse("stiffness of a machine", stiffness, "N/m",
            "must be given once, was " + number(p.machine_stiffness) + " N/m");
    }
    p.machine_stiffness = stiffness;
    p.machine_give = dot(p.normal, p.force) / stiffness;
}

int plate_points(const Plate& p) { return static_cast<int>(p.facets.size()) * p.points; }

PlatePoint plate_point(const Plate& p, int index)
{
    return { p.facets[index / p.points], plate_weight(p, index % p.points),
        p.stiffness * p.area[index], p.friction > 0.0 ? p.shear_stiffness * p.area[index] : 0.0 };
}

Vector point_force(const Plate& p, int index)
{
    const double normal = normal_force(p, plate_point(p, index), p.opening[index]);
    const Vector along = point_normal(p, index);
    return normal * along + p.shear_force[index] * tangent_of(in_plane(along));
}

void update_plates(Assembly& a, double dt, double damping)
{
    for (const Plate& plate : a.plates) {
        for (int facet : plate.facets) {
            for (int n = 0; n < facet_nodes; ++n) {
                const int at = Facets::force_index(facet, FacetRow::of_plates, n);
                set_vector(a.facets.forces, at, {});
            }
        }
    }
    for (std::size_t i = 0; i < a.plates.size(); ++i)
        update_plate(a, i, dt, damping);
}

double elastic_energy(const Plate& plate)
{
    double total = 0.0;
    for (int i = 0; i < plate_points(plate); ++i) {
        const PlatePoint p = plate_point(plate, i);
        const double gap = plate.bonded ? plate.opening[i] : std::min(plate.opening[i], 0.0);
        total += 0.5 * p.stiffness * gap * gap;
        if (p.shear_stiffness > 0.0) {
            total += 0.5 * plate.shear_force[i] * plate.shear_force[i] / p.shear_stiffness;
        }
    }
    return total;
}

bool has_plates(const Assembly& a, int side)
{
    return std::any_of(
        a.plates.begin(), a.plates.end(), [side](const Plate& p) { return p.side == side; });
}

Vector plate_force(const Assembly& a, int side)
{
    Vector sum;
    for (const Plate& p : a.plates) {
        if (p.side != side) continue;
        sum = sum + p.force;
    }
    return sum;
}

Point middle_of_face(const Assembly& a, const Plate& p)
{
    Point sum;
    double area = 0.0;
    for (int i = 0; i < plate_points(p); ++i) {
        const PlatePoint point = plate_point(p, i);
        const Point x =
            vector_on_edge(a.grains.reference, a.facets.nodes(point.facet), point.weight);
        sum = sum + p.area[i] * x;
        area += p.area[i];
    }
    return area > 0.0 ? (1.0 / area) * sum : in_plane(p.position);
}

double contact_width(const Assembly& a, int plate)
{
    const Plate& p = a.plates.at(plate);
    const Point tangent = tangent_of(in_plane(p.normal));
    double first = 0.0, last = 0.0;
    bool any = false;
    for (int i = 0; i < plate_points(p); ++i) {
        if (p.opening[i] >= 0.0) continue;
        const PlatePoint point = plate_point(p, i);
        const auto nodes = a.facets.nodes(point.facet);
        const Point x = vector_on_edge(a.grains.reference, nodes, point.weight)
            + vector_on_edge(a.grains.displacement, nodes, point.weight);
        const double place = dot(tangent, x);
        const double half = a.length_of(0.5 * p.area[i]);
        first = any ? std::min(first, place - half) : place - half;
        last = any ? std::max(last, place + half) : place + half;
        any = true;
    }
    return last - first;
}

double contact_angle(const Assembly& a, int plate)
{
    const Plate& p = a.plates.at(plate);
    if (p.jaw_radius == 0.0) return 0.0;
    const Vector centre = p.position + p.disc_radius * p.normal;
    const Point tangent = tangent_of(in_plane(p.normal));
    // a node beyond the end of the arc bears for the part of its edge that is before it
    const double end = std::asin(std::min(0.5 * p.width / p.disc_radius, 1.0));
    double first = 0.0, last = 0.0;
    bool any = false;
    for (int i = 0; i < plate_points(p); ++i) {
        if (p.opening[i] >= 0.0 || p.area[i] == 0.0) continue;
        const PlatePoint point = plate_point(p, i);
        const Vector arm =
            vector_on_edge(a.grains.reference, a.facets.nodes(point.facet), point.weight) - centre;
        const double place = std::atan2(dot(tangent, arm), -dot(p.normal, arm));
        const double half = a.length_of(0.5 * p.area[i]) / p.disc_radius;
        const double from = std::max(place - half, -end), to = std::min(place + half, end);
        first = any ? std::min(first, from) : from;
        last = any ? std::max(last, to) : to;
        any = true;
    }
    return last - first;
}

}  // namespace flexpm
