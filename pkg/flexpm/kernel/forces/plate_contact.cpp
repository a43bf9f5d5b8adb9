// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Plates against boundary edges.
#include <flexpm/kernel/forces/plate_contact.hpp>

#include <flexpm/kernel/motion/central_difference.hpp>

#include <algorithm>
#include <cmath>

namespace flexpm {

namespace {

Point tangent_of(const Plate& p) { return { -p.normal.y, p.normal.x }; }

/// A value of a node array at a point of an edge.
struct EdgeValues {
    int n0, n1;
    double weight;

    Point of(const Array<double>& values) const
    {
        return { (1.0 - weight) * values[n0] + weight * values[n1],
            (1.0 - weight) * values[n0 + lanes] + weight * values[n1 + lanes] };
    }
};

EdgeValues values_at(const Assembly& a, const PlatePoint& p)
{
    return { a.edge_nodes[row_index(p.edge, 0, 2)], a.edge_nodes[row_index(p.edge, 1, 2)],
        p.weight };
}

void add_force(Assembly& a, const PlatePoint& p, Point force)
{
    double* f = &a.edge_force[row_index(p.edge, ContactRows::plate, ContactRows::forces)];
    f[0] += (1.0 - p.weight) * force.x;
    f[lanes] += (1.0 - p.weight) * force.y;
    f[2 * lanes] += p.weight * force.x;
    f[3 * lanes] += p.weight * force.y;
}

/// Shear force after a slip of the grain along the plate [m], within friction; books what rubs off.
double shear_force(Plate& plate, const PlatePoint& p, int index, double normal_force, double slip)
{
    const double old = plate.shear_force[index], trial = old - p.shear_stiffness * slip;
    const double limit = plate.friction * std::max(normal_force, 0.0);
    const double next = std::min(std::max(trial, -limit), limit);
    plate.friction_energy += 0.5 * (old + next) * (trial - next) / p.shear_stiffness;
    return next;
}

/// Contact forces at the end of a step that began at the present displacements of the nodes.
Point touch(Assembly& a, Plate& plate, double dt)
{
    const Point tangent = tangent_of(plate);
    Point total;
    for (int i = 0; i < plate_points(plate); ++i) {
        const PlatePoint p = plate_point(plate, i);
        const EdgeValues at = values_at(a, p);
        const Point u = at.of(a.displacement), v = at.of(a.velocity);
        const Point way = { u.x + dt * v.x - plate.displacement.x,
            u.y + dt * v.y - plate.displacement.y };
        const double gap = plate.gap[i] + dot(plate.normal, way);
        plate.opening[i] = gap;
        const double normal = gap < 0.0 || plate.bonded ? -p.stiffness * gap : 0.0;
        if (plate.friction > 0.0) {
            const Point slip = { dt * (v.x - plate.velocity.x), dt * (v.y - plate.velocity.y) };
            plate.shear_force[i] = shear_force(plate, p, i, normal, dot(tangent, slip));
        }
        const double shear = plate.shear_force[i];
        const Point force = { normal * plate.normal.x + shear * tangent.x,
            normal * plate.normal.y + shear * tangent.y };
        add_force(a, p, force);
        total.x += force.x;
        total.y += force.y;
    }
    return total;
}

/// A loaded plate answers to its load and to the specimen along its normal.
void integrate_loaded(Plate& plate, double dt, double damping)
{
    const double net = plate.load - dot(plate.normal, plate.force);
    double speed = dot(plate.normal, plate.velocity);
    const double old = speed;
    StepSums sums;
    integrate_one<true>(net, 0.0, 1.0 / plate.mass, 1.0, dt, damping, speed, sums, 0);
    plate.velocity = { speed * plate.normal.x, speed * plate.normal.y };
    plate.damping_work += plate.damping_work_next + sums.damped[0];
    plate.damping_work_next = sums.damped_next[0];
    plate.boundary_work += plate.boundary_work_next + 0.5 * dt * plate.load * old;
    plate.boundary_work_next = 0.5 * dt * plate.load * speed;
    plate.kinetic = sums.kinetic[0];
    plate.unbalanced = sums.largest[0];
}

void update_plate(Assembly& a, Plate& plate, double dt, double damping)
{
    const Point before = plate.force;
    plate.displacement.x += dt * plate.velocity.x;
    plate.displacement.y += dt * plate.velocity.y;
    plate.force = touch(a, plate, dt);
    if (plate.loaded) {
        integrate_loaded(plate, dt, damping);
    } else {
        const Point mean = { 0.5 * (before.x + plate.force.x), 0.5 * (before.y + plate.force.y) };
        plate.boundary_work += dt * dot(mean, plate.velocity);
    }
}

}  // namespace

int plate_points(const Plate& p) { return static_cast<int>(p.edges.size()) * p.points; }

PlatePoint plate_point(const Plate& p, int index)
{
    return { p.edges[index / p.points], plate_weight(p, index % p.points),
        p.stiffness * p.area[index], p.friction > 0.0 ? p.shear_stiffness * p.area[index] : 0.0 };
}

void update_plates(Assembly& a, double dt, double damping)
{
    for (const Plate& plate : a.plates) {
        for (int edge : plate.edges) {
            for (int row = 0; row < 4; ++row) {
                a.edge_force[row_index(edge, ContactRows::plate + row, ContactRows::forces)] = 0.0;
            }
        }
    }
    for (Plate& plate : a.plates)
        update_plate(a, plate, dt, damping);
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

Point plate_force(const Assembly& a, int side)
{
    Point sum;
    for (const Plate& p : a.plates) {
        if (p.side != side) continue;
        sum.x += p.force.x;
        sum.y += p.force.y;
    }
    return sum;
}

double contact_width(const Assembly& a, int plate)
{
    const Plate& p = a.plates.at(plate);
    const Point tangent = tangent_of(p);
    double first = 0.0, last = 0.0;
    bool any = false;
    for (int i = 0; i < plate_points(p); ++i) {
        if (p.opening[i] >= 0.0) continue;
        const EdgeValues at = values_at(a, plate_point(p, i));
        const Point x = at.of(a.reference), u = at.of(a.displacement);
        const double place = dot(tangent, { x.x + u.x, x.y + u.y });
        const double half = 0.5 * p.area[i] / a.thickness;
        first = any ? std::min(first, place - half) : place - half;
        last = any ? std::max(last, place + half) : place + half;
        any = true;
    }
    return last - first;
}

}  // namespace flexpm
