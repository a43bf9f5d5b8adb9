// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Plates against facets.
#include <flexpm/kernel/parts/plate_contact.hpp>

#include <flexpm/kernel/parts/plate_loading.hpp>
#include <flexpm/kernel/parts/soft_plate.hpp>

#include <algorithm>
#include <cmath>

namespace flexpm {

namespace {

void add_force(Facets& facets, const EdgePoint& p, Vector force)
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
double shear_force(
    Plate& plate, PlatePoint& point, double stiffness, double normal_force, double slip)
{
    const double old = point.shear.x, trial = old - stiffness * slip;
    const double next = within_friction(plate, normal_force, trial);
    if (next == trial) return next;
    if (old != 0.0 || next != 0.0) {  // else nothing touches
        const double rubs = 0.5 * (old + next) * (trial - next) / stiffness;
        plate.friction_energy += rubs;
        point.friction_energy += rubs;
    }
    point.slip = point.slip + (next - trial) / stiffness * tangent_of(in_plane(point.normal));
    return next;
}

/// Contact forces at the end of a step that began at the present displacements of the nodes.
///
/// @param give  of the plate, beside its velocity, against its normal [m]
Vector touch(Assembly& a, Plate& plate, double give, double dt)
{
    Vector total;
    for (int i = 0; i < plate_points(plate); ++i) {
        const EdgePoint p = edge_point(plate, i);
        PlatePoint& point = plate.points[i];
        const Vector along = point.normal, tangent = tangent_of(in_plane(along));
        const auto nodes = a.facets.nodes(p.facet);
        const Point u = vector_on_edge(a.grains.displacement, nodes, p.weight);
        const Point v = vector_on_edge(a.grains.velocity, nodes, p.weight);
        const Vector way = u + dt * v - plate.displacement;
        point.opening = gap_after(plate, i, way);
        const double normal = point_push(plate, i);
        if (plate.friction > 0.0) {
            double slip = dot(tangent, dt * (v - plate.velocity));
            // a straight plate gives square to its face
            if (is_jaw(plate)) slip += give * dot(tangent, plate.normal);
            point.shear.x = shear_force(plate, point, p.shear_stiffness, normal, slip);
        }
        const Vector force = normal * along + point.shear.x * tangent;
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
    const double give = plate.seated || gives_way(plate) ? give_way(a, plate, dt) : 0.0;
    plate.force = touch(a, plate, give, dt);
    if (machine && plate.loaded)
        plate.machine_give = dot(plate.normal, plate.force) / plate.machine_stiffness;
    if (plate.loaded) {
        integrate_loaded(a, number, a.facets.grain, dt, damping);
    } else if (machine) {
        plate.boundary_work += dot(0.5 * (before + plate.force), plate.displacement - from);
    } else {
        plate.boundary_work += dt * dot(0.5 * (before + plate.force), plate.velocity);
    }
}

}  // namespace

EdgePoint edge_point(const Plate& p, int index)
{
    const PlatePoint& point = p.points[index];
    return { point.facet, point.weights[1], point_stiffness(p, index),
        sliding_stiffness(p, index) };
}

void update_plates(Assembly& a, double dt, double damping)
{
    for (const Plate& plate : a.plates) {
        int done = -1;  // points of a facet follow each other
        for (const PlatePoint& point : plate.points) {
            if (point.facet == done) continue;
            done = point.facet;
            for (int n = 0; n < facet_nodes; ++n) {
                const int at = Facets::force_index(done, FacetRow::of_plates, n);
                set_vector(a.facets.forces, at, {});
            }
        }
    }
    for (std::size_t i = 0; i < a.plates.size(); ++i)
        update_plate(a, i, dt, damping);
}

Point middle_of_face(const Assembly& a, const Plate& p)
{
    Point sum;
    double area = 0.0;
    for (int i = 0; i < plate_points(p); ++i) {
        const EdgePoint point = edge_point(p, i);
        const Point x =
            vector_on_edge(a.grains.reference, a.facets.nodes(point.facet), point.weight);
        sum = sum + p.points[i].area * x;
        area += p.points[i].area;
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
        if (p.points[i].opening >= 0.0) continue;
        const EdgePoint point = edge_point(p, i);
        const auto nodes = a.facets.nodes(point.facet);
        const Point x = vector_on_edge(a.grains.reference, nodes, point.weight)
            + vector_on_edge(a.grains.displacement, nodes, point.weight);
        const double place = dot(tangent, x);
        const double half = a.length_of(0.5 * p.points[i].area);
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
        if (p.points[i].opening >= 0.0 || p.points[i].area == 0.0) continue;
        const EdgePoint point = edge_point(p, i);
        const Vector arm =
            vector_on_edge(a.grains.reference, a.facets.nodes(point.facet), point.weight) - centre;
        const double place = std::atan2(dot(tangent, arm), -dot(p.normal, arm));
        const double half = a.length_of(0.5 * p.points[i].area) / p.disc_radius;
        const double from = std::max(place - half, -end), to = std::min(place + half, end);
        first = any ? std::min(first, from) : from;
        last = any ? std::max(last, to) : to;
        any = true;
    }
    return last - first;
}

}  // namespace flexpm
