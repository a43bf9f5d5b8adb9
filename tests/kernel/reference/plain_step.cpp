// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference/plain_step.hpp"

#include "reference/point_law.hpp"

#include <algorithm>
#include <cmath>

namespace plain {

namespace {

using flexpm::cross;
using flexpm::dot;

/// What a rotation adds to a vector: (cos - 1) r and sin across it, without loss of digits for a
/// small angle.
Point turned_by(double angle, Point r)
{
    const double half = std::sin(0.5 * angle);
    const double along = -2.0 * half * half, across = std::sin(angle);
    return { along * r.x - across * r.y, across * r.x + along * r.y };
}

Point unit(Point p) { return (1.0 / flexpm::norm(p)) * p; }

/// Vector at share `weight` of an edge.
Point on_edge(Point first, Point second, double weight)
{
    return (1.0 - weight) * first + weight * second;
}

// ---- contacts, Eqs. 5-19 and D24 ---------------------------------------------------------------

/// Unit normal at the present places: between the centres (Eq. 5), or across the mean of both
/// edges.
Point normal_of(const Specimen& s, const Contact& c)
{
    if (!c.across_edges) {
        const Node &a = s.nodes[s.grains[c.grains[0]].centre],
                   &b = s.nodes[s.grains[c.grains[1]].centre];
        return unit(c.branch + (b.displacement - a.displacement));
    }
    Point along;
    for (const auto& edge : c.edge) {
        const Node &first = s.nodes[edge[0]], &second = s.nodes[edge[1]];
        along = along + (second.reference - first.reference)
            + (second.displacement - first.displacement);
    }
    return unit({ along.y, -along.x });
}

/// Advance a contact to the present places, which the nodes have reached with their velocities.
void update_contact(Specimen& s, Contact& c, double dt)
{
    const Point old_normal = c.normal;
    c.normal = normal_of(s, c);
    // increments refer to the mean of the old and the new normal
    const Point mean = 0.5 * (old_normal + c.normal);
    const auto way = [&](int node) { return dt * s.nodes[node].velocity; };

    double turn = 0.0;  // mean rotation of the two edges in this step
    for (int side = 0; side < 2; ++side) {
        const Point stretch = way(c.edge[side][1]) - way(c.edge[side][0]);
        turn -= 0.5 * c.per_length[side] * dot(stretch, mean);
    }

    double gap_moment = 0.0;
    Point on_ends[2][2];  // sums of normal (x) and shear (y) force: side, end
    for (ContactPoint& p : c.points) {
        Point way_of[2];
        for (int side = 0; side < 2; ++side)
            way_of[side] = on_edge(way(c.edge[side][0]), way(c.edge[side][1]), p.weight[side]);
        const Point apart = way_of[1] - way_of[0];
        const double opens = dot(apart, mean), slips = cross(mean, apart);
        // both grains are compared in the middle of the gap, to which each edge carries its
        // rotation; the gap is that of half of the step
        const double along = p.state.slip - p.paired_slip;
        const double opening = p.state.opening + 0.5 * (opens + turn * along);
        const double slip = along + 0.5 * (slips - turn * p.state.opening);
        const PointTraction t = advance(c.law, opens + turn * slip, slips - turn * opening, p);

        const double normal = p.area * t.normal, shear = p.area * t.shear;
        gap_moment += p.state.opening * shear - (p.state.slip - p.paired_slip) * normal;
        for (int side = 0; side < 2; ++side) {
            const double sign = side == 0 ? 1.0 : -1.0, w = p.weight[side];
            on_ends[side][0] = on_ends[side][0] + sign * (1.0 - w) * Point { normal, shear };
            on_ends[side][1] = on_ends[side][1] + sign * w * Point { normal, shear };
        }
        if (!t.cracks) continue;
        p.crack_step = static_cast<int>(s.step + 1);
        p.crack_mode = t.gap > 0.0 ? 1 : 2;
        p.crack_place = {};
        for (int side = 0; side < 2; ++side) {
            p.crack_place = p.crack_place
                + 0.5
                    * on_edge(s.nodes[c.edge[side][0]].place(), s.nodes[c.edge[side][1]].place(),
                        p.weight[side]);
        }
    }
    // forces act in the middle of the gap: each edge takes half of its moment as a couple along the
    // normal
    for (int side = 0; side < 2; ++side) {
        const double couple = 0.5 * gap_moment * c.per_length[side];
        on_ends[side][0].x += couple;
        on_ends[side][1].x -= couple;
        for (int end = 0; end < 2; ++end) {
            const Point f = on_ends[side][end], n = c.normal;
            s.nodes[c.edge[side][end]].push(f.x * n + f.y * Point { -n.y, n.x });
        }
    }
}

// ---- boundary ----------------------------------------------------------------------------------

/// Pressure follows the edge: half of it to either node.
void press(Specimen& s, const BoundaryEdge& e)
{
    const Point along = s.nodes[e.nodes[1]].place() - s.nodes[e.nodes[0]].place();
    const double half = 0.5 * e.pressure * s.thickness;
    for (int node : e.nodes)
        s.nodes[node].push(half * Point { -along.y, along.x });
}

/// Time step and alpha of Eq. 2.
struct Integration {
    double dt, damping;
};

/// Velocity half a step after the force, with local damping of what it has beyond what is left
/// alone.
double accelerated(
    double velocity, double undamped, double force, double inverse_mass, Integration by)
{
    const double own = velocity - undamped;
    const double sign = own > 0.0 ? 1.0 : (own < 0.0 ? -1.0 : 0.0);
    return velocity + by.dt * (force - by.damping * std::fabs(force) * sign) * inverse_mass;
}

/// A spring at each point, with friction; a loaded plate moves along its normal as a body of its
/// own.
void push(Specimen& s, Plate& plate, double dt, double damping)
{
    plate.displacement = plate.displacement + dt * plate.velocity;
    plate.force = {};
    const Point n = plate.normal, tangent { -n.y, n.x };
    for (PlatePoint& p : plate.points) {
        Node &first = s.nodes[p.nodes[0]], &second = s.nodes[p.nodes[1]];
        const Point way = on_edge(first.displacement, second.displacement, p.weight);
        const double gap = p.gap + dot(n, way - plate.displacement);
        double normal = 0.0;
        if (gap < 0.0 || plate.bonded) normal = -plate.stiffness * p.area * gap;
        if (plate.friction > 0.0) {
            const Point velocity = on_edge(first.velocity, second.velocity, p.weight);
            const double slip = dt * dot(tangent, velocity - plate.velocity);
            const double trial = p.shear_force - plate.shear_stiffness * p.area * slip;
            const double limit = plate.friction * std::max(normal, 0.0);
            p.shear_force = std::clamp(trial, -limit, limit);
        }
        const Point force = normal * n + p.shear_force * tangent;
        first.push((1.0 - p.weight) * force);
        second.push(p.weight * force);
        plate.force = plate.force + force;
    }
    if (!plate.loaded) return;
    const double net = plate.load - dot(n, plate.force), speed = dot(n, plate.velocity);
    const double undamped = dot(n, plate.undamped_velocity);
    plate.velocity = accelerated(speed, undamped, net, 1.0 / plate.mass, { dt, damping }) * n;
}

// ---- triangles ---------------------------------------------------------------------------------

struct Matrix {
    double xx, xy, yx, yy;
};

Matrix operator*(const Matrix& a, const Matrix& b)
{
    return { a.xx * b.xx + a.xy * b.yx, a.xx * b.xy + a.xy * b.yy, a.yx * b.xx + a.yy * b.yx,
        a.yx * b.xy + a.yy * b.yy };
}

/// S = C E of plane stress or plane strain (Hooke's law).
Matrix second_stress(const flexpm::ElasticMaterial& m, const Matrix& e)
{
    const double g = m.young / (2.0 * (1.0 + m.poisson));
    double lambda = m.young * m.poisson / ((1.0 + m.poisson) * (1.0 - 2.0 * m.poisson));
    if (m.plane == flexpm::Plane::stress) lambda = 2.0 * g * m.poisson / (1.0 - m.poisson);
    const double trace = lambda * (e.xx + e.yy);
    return { trace + 2.0 * g * e.xx, 2.0 * g * e.xy, 2.0 * g * e.yx, trace + 2.0 * g * e.yy };
}

/// f = -V (I + H) S grad N on each node.
void strain_triangle(Specimen& s, const Grain& grain, const std::array<int, 3>& corners)
{
    Point x[3], u[3], gradient[3];
    for (int i = 0; i < 3; ++i) {
        x[i] = s.nodes[corners[i]].reference;
        u[i] = s.nodes[corners[i]].displacement;
    }
    const double twice_area = cross(x[1] - x[0], x[2] - x[0]);
    for (int i = 0; i < 3; ++i) {
        const Point opposite = x[(i + 2) % 3] - x[(i + 1) % 3];
        gradient[i] = (1.0 / twice_area) * Point { -opposite.y, opposite.x };
    }
    Matrix h {};
    for (int i = 1; i < 3; ++i) {
        const Point d = u[i] - u[0];
        h.xx += d.x * gradient[i].x;
        h.xy += d.x * gradient[i].y;
        h.yx += d.y * gradient[i].x;
        h.yy += d.y * gradient[i].y;
    }
    const Matrix square = Matrix { h.xx, h.yx, h.xy, h.yy } * h;  // H^T H
    const double shear = 0.5 * (h.xy + h.yx + square.xy);
    const Matrix strain { h.xx + 0.5 * square.xx, shear, shear, h.yy + 0.5 * square.yy };
    const Matrix stress = second_stress(grain.elastic, strain);
    const Matrix first = Matrix { 1.0 + h.xx, h.xy, h.yx, 1.0 + h.yy } * stress;
    const double volume = 0.5 * twice_area * s.thickness;
    // where a grain turns, parts of H that are much larger than the strain cancel
    const double largest =
        std::max({ std::fabs(h.xx), std::fabs(h.xy), std::fabs(h.yx), std::fabs(h.yy) });
    for (int i = 0; i < 3; ++i) {
        Node& node = s.nodes[corners[i]];
        const Point g = gradient[i];
        node.largest_part =
            std::max(node.largest_part, volume * grain.elastic.young * largest * flexpm::norm(g));
        node.push(
            -volume * Point { first.xx * g.x + first.xy * g.y, first.yx * g.x + first.yy * g.y });
    }
}

// ---- motion, Eqs. 1-3 --------------------------------------------------------------------------

void accelerate(Node& n, Point force, Integration by)
{
    const Point old = n.velocity, undamped = n.undamped_velocity;
    if (!n.held_x) n.velocity.x = accelerated(old.x, undamped.x, force.x, n.inverse_mass, by);
    if (!n.held_y) n.velocity.y = accelerated(old.y, undamped.y, force.y, n.inverse_mass, by);
}

/// Places at the end of the step. The nodes of a rigid grain follow its centre by exact rotation.
void move(Specimen& s, Grain& grain, double dt)
{
    if (!grain.is_rigid()) {
        for (int n : grain.nodes)
            s.nodes[n].displacement = s.nodes[n].displacement + dt * s.nodes[n].velocity;
        return;
    }
    grain.angle += dt * grain.spin;
    Node& centre = s.nodes[grain.centre];
    centre.displacement = centre.displacement + dt * centre.velocity;
    for (int n : grain.nodes) {
        const Point arm = s.nodes[n].reference - centre.reference;
        s.nodes[n].displacement = centre.displacement + turned_by(grain.angle, arm);
    }
}

void accelerate(Specimen& s, Grain& grain, Integration by)
{
    if (!grain.is_rigid()) {
        for (int n : grain.nodes)
            accelerate(s.nodes[n], s.nodes[n].force, by);
        return;
    }
    Node& centre = s.nodes[grain.centre];
    Point force;
    double moment = 0.0;
    for (int n : grain.nodes) {
        force = force + s.nodes[n].force;
        moment += cross(s.nodes[n].place() - centre.place(), s.nodes[n].force);
    }
    accelerate(centre, force, by);
    if (!grain.spin_held)
        grain.spin =
            accelerated(grain.spin, grain.undamped_spin, moment, grain.inverse_inertia, by);
    // velocities of the nodes whose product with dt is the exact way of the coming step
    for (int n : grain.nodes) {
        const Point arm = s.nodes[n].place() - centre.place();
        s.nodes[n].velocity = centre.velocity + (1.0 / by.dt) * turned_by(by.dt * grain.spin, arm);
    }
}

}  // namespace

void step(Specimen& s, double dt, double damping)
{
    for (Grain& grain : s.grains)
        move(s, grain, dt);
    for (Node& node : s.nodes) {
        const double mass = node.inverse_mass > 0.0 ? 1.0 / node.inverse_mass : 0.0;
        node.force = {};
        node.push(mass * s.gravity);
    }
    for (Contact& contact : s.contacts) {
        if (contact.active) update_contact(s, contact, dt);
    }
    for (const BoundaryEdge& edge : s.edges)
        press(s, edge);
    for (Plate& plate : s.plates)
        push(s, plate, dt, damping);
    for (const Grain& grain : s.grains) {
        for (const auto& triangle : grain.triangles)
            strain_triangle(s, grain, triangle);
    }
    for (Grain& grain : s.grains)
        accelerate(s, grain, { dt, damping });
    ++s.step;
}

}  // namespace plain
