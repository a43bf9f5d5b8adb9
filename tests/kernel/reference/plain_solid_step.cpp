// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Forces and motion of a plain solid specimen, written from doc/theory.
#include "reference/plain_solid.hpp"

#include <flexpm/kernel/space/face_frame.hpp>

#include <cmath>

namespace plain_solid {

namespace {

using flexpm::cross;
using flexpm::dot;
using flexpm::FaceFrame;
using flexpm::Quaternion;
using flexpm::SpaceTensor;

double sign(double value) { return value > 0.0 ? 1.0 : (value < 0.0 ? -1.0 : 0.0); }

/// Forces of a contact: its points along the frame of the middle face, their couple on that.
void update_contact(Specimen& s, Contact& c)
{
    const std::size_t corners = c.corners[0].size();
    std::vector<Vector> middle(corners), apart(corners);
    for (std::size_t k = 0; k < corners; ++k) {
        const Node &a = s.nodes[c.corners[0][k]], &b = s.nodes[c.corners[1][k]];
        middle[k] = 0.5 * (a.place() + b.place());
        apart[k] = b.displacement - a.displacement;
    }
    const FaceFrame frame = flexpm::face_frame(middle, c.line);
    std::vector<Vector> on_a(corners);
    Vector couple;
    for (ContactPoint& p : c.points) {
        Vector jump;
        for (std::size_t k = 0; k < corners; ++k)
            jump = jump + p.shares[k] * apart[k];
        const Point slip_before = p.at.slip;
        p.at = { dot(jump, frame.normal), { dot(jump, frame.first), dot(jump, frame.second) } };
        p.traction = flexpm::advance_face_point(c.law, p.at, slip_before, p.state);
        const Vector force = p.area
            * (p.traction.normal * frame.normal + p.traction.shear.x * frame.first
                + p.traction.shear.y * frame.second);
        couple = couple + cross(force, jump);
        for (std::size_t k = 0; k < corners; ++k)
            on_a[k] = on_a[k] + p.shares[k] * force;
    }
    const std::vector<Vector> turning = flexpm::couple_forces(frame, middle, c.line, couple);
    for (std::size_t k = 0; k < corners; ++k) {
        Node &a = s.nodes[c.corners[0][k]], &b = s.nodes[c.corners[1][k]];
        a.force = a.force + on_a[k] + 0.5 * turning[k];
        b.force = b.force - on_a[k] + 0.5 * turning[k];
    }
}

std::array<Node*, 4> corners_of(Specimen& s, const std::array<int, 4>& element)
{
    return { &s.nodes[element[0]], &s.nodes[element[1]], &s.nodes[element[2]],
        &s.nodes[element[3]] };
}

flexpm::TetrahedronShape shape_of(const std::array<Node*, 4>& n)
{
    return flexpm::tetrahedron_shape(
        n[0]->reference, n[1]->reference, n[2]->reference, n[3]->reference);
}

void strain_element(Specimen& s, const std::array<int, 4>& element)
{
    const auto n = corners_of(s, element);
    const auto f = flexpm::tetrahedron_forces(shape_of(n), s.elastic, n[0]->displacement,
        n[1]->displacement, n[2]->displacement, n[3]->displacement);
    n[0]->force = n[0]->force - (f.f1 + f.f2 + f.f3);
    n[1]->force = n[1]->force + f.f1;
    n[2]->force = n[2]->force + f.f2;
    n[3]->force = n[3]->force + f.f3;
}

/// The work of forces at the present places in the half step behind and in the one ahead.
void lose(double& behind, double& ahead, double old, double next)
{
    behind += 0.5 * old;
    ahead += 0.5 * next;
}

/// Velocity along one axis half a step after the force.
double accelerated(
    Specimen& s, double old, double force, double inverse, bool held, std::array<double, 2> by)
{
    const auto [dt, damping] = by;
    if (held) {
        lose(s.works.boundary, s.works.boundary_next, -dt * force * old, -dt * force * old);
        return old;
    }
    const double damp = -damping * std::fabs(force) * sign(old);
    const double next = old + dt * (force + damp) * inverse;
    lose(s.works.damping, s.works.damping_next, -dt * damp * old, -dt * damp * next);
    return next;
}

Vector inertia_times(const Grain& g, const Quaternion& turn, Vector spin)
{
    return flexpm::turned(turn, g.inertia * flexpm::turned(flexpm::inverse(turn), spin));
}

/// Solve I w = l.
Vector solve(const SpaceTensor& i, Vector l)
{
    const Vector x { i.xx, i.xy, i.xz }, y { i.xy, i.yy, i.yz }, z { i.xz, i.yz, i.zz };
    const double whole = triple(x, y, z);
    return (1.0 / whole) * Vector { triple(l, y, z), triple(x, l, z), triple(x, y, l) };
}

/// Spin half a step later, whose turn in the middle of the step has the angular momentum.
void spin_up(Grain& g, double dt)
{
    for (int round = 0; round < 6; ++round) {
        const Quaternion there = flexpm::rotation_by(0.5 * dt * g.spin) * g.turn;
        const Vector own = flexpm::turned(flexpm::inverse(there), g.angular_momentum);
        g.spin = flexpm::turned(there, solve(g.inertia, own));
    }
}

void accelerate_turn(Specimen& s, Grain& g, std::array<double, 2> by)
{
    const auto [dt, damping] = by;
    const Vector old = g.spin, m = g.moment;
    if (g.spin_held) {
        const double work = -dt * dot(m, old);
        lose(s.works.boundary, s.works.boundary_next, work, work);
        g.angular_momentum = inertia_times(g, g.turn, g.spin);
        return;
    }
    const Vector damp = -damping
        * Vector { std::fabs(m.x) * sign(old.x), std::fabs(m.y) * sign(old.y),
              std::fabs(m.z) * sign(old.z) };
    g.angular_momentum = g.angular_momentum + dt * (m + damp);
    spin_up(g, dt);
    lose(s.works.damping, s.works.damping_next, -dt * dot(damp, old), -dt * dot(damp, g.spin));
}

void gather(Specimen& s, Grain& g)
{
    Node& centre = s.nodes[g.centre()];
    g.moment = {};
    for (int n : g.nodes) {
        if (n == g.centre()) continue;
        g.moment = g.moment + cross(s.nodes[n].place() - centre.place(), s.nodes[n].force);
        centre.force = centre.force + s.nodes[n].force;
    }
}

void accelerate(Specimen& s, Node& n, std::array<double, 2> by)
{
    const double inverse = n.mass > 0.0 ? 1.0 / n.mass : 0.0;
    n.velocity = { accelerated(s, n.velocity.x, n.force.x, inverse, n.held[0], by),
        accelerated(s, n.velocity.y, n.force.y, inverse, n.held[1], by),
        accelerated(s, n.velocity.z, n.force.z, inverse, n.held[2], by) };
}

double kinetic_energy(const Node& n, Vector old)
{
    const Vector v = n.velocity;
    return 0.5 * n.mass
        * ((n.held[0] ? 0.0 : old.x * v.x) + (n.held[1] ? 0.0 : old.y * v.y)
            + (n.held[2] ? 0.0 : old.z * v.z));
}

void add_stored(Specimen& s, Energies& e)
{
    for (const Grain& g : s.grains) {
        for (const auto& element : g.elements) {
            const auto n = corners_of(s, element);
            e.strain += flexpm::tetrahedron_energy(shape_of(n), s.elastic, n[0]->displacement,
                n[1]->displacement, n[2]->displacement, n[3]->displacement);
        }
    }
    for (const Contact& c : s.contacts) {
        for (const ContactPoint& p : c.points) {
            e.contact += p.area * flexpm::law::elastic_energy(c.law, p.at, p.state);
            e.damage += p.area * p.state.damage_energy;
            e.friction += p.area * p.state.friction_energy;
        }
    }
}

}  // namespace

void follow(Specimen& s)
{
    for (const Grain& g : s.grains) {
        if (!g.is_rigid()) continue;
        const Node& centre = s.nodes[g.centre()];
        for (int n : g.nodes) {
            const Vector arm = s.nodes[n].reference - centre.reference;
            s.nodes[n].displacement = centre.displacement + flexpm::turned_by(g.turn, arm);
        }
    }
}

void find_forces(Specimen& s)
{
    for (Node& node : s.nodes)
        node.force = {};
    for (Contact& contact : s.contacts)
        update_contact(s, contact);
    for (Grain& g : s.grains) {
        for (const auto& element : g.elements)
            strain_element(s, element);
        if (g.is_rigid()) gather(s, g);
    }
}

Energies step(Specimen& s, double dt, double damping)
{
    s.works.damping += s.works.damping_next;
    s.works.boundary += s.works.boundary_next;
    s.works.damping_next = s.works.boundary_next = 0.0;
    for (Node& n : s.nodes)
        n.displacement = n.displacement + dt * n.velocity;
    for (Grain& g : s.grains)
        if (g.is_rigid()) g.turn = normalized(flexpm::rotation_by(dt * g.spin) * g.turn);
    follow(s);
    find_forces(s);
    Energies e;
    for (Node& n : s.nodes) {
        if (n.rides) continue;
        const Vector old = n.velocity;
        accelerate(s, n, { dt, damping });
        e.kinetic += kinetic_energy(n, old);
    }
    for (Grain& g : s.grains) {
        if (!g.is_rigid()) continue;
        const Vector spin = g.spin, momentum = g.angular_momentum;
        accelerate_turn(s, g, { dt, damping });
        if (!g.spin_held)
            e.kinetic += 0.25 * (dot(spin, g.angular_momentum) + dot(g.spin, momentum));
    }
    add_stored(s, e);
    return e;
}

}  // namespace plain_solid
