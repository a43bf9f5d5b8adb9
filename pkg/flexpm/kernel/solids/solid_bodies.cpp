// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/solids/solid_bodies.hpp>

#include <flexpm/kernel/core/require.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace flexpm {

namespace {

/// Solve I w = l.
Vector solve(const SpaceTensor& i, Vector l)
{
    const Vector x { i.xx, i.xy, i.xz }, y { i.xy, i.yy, i.yz }, z { i.xz, i.yz, i.zz };
    const double whole = triple(x, y, z);
    return (1.0 / whole) * Vector { triple(l, y, z), triple(x, l, z), triple(x, y, l) };
}

/// Spin half a step after the turn of a body with its angular momentum.
Vector spin_of(const RigidBody& body, double dt)
{
    // converges to the last digit for the turns of a step
    constexpr int rounds = 6;
    Vector spin = body.spin;
    for (int round = 0; round < rounds; ++round) {
        const Quaternion there = rotation_by(0.5 * dt * spin) * body.turn;
        spin = turned(there, solve(body.inertia, turned(inverse(there), body.angular_momentum)));
    }
    return spin;
}

/// Local damping of a moment, Eq. 2 for each component.
/// @param spin  beyond what damping leaves alone
Vector damping_moment(Vector moment, Vector spin, double damping)
{
    const auto against = [&](double m, double w) {
        return (w > 0.0 ? -damping : (w < 0.0 ? damping : 0.0)) * std::fabs(m);
    };
    return { against(moment.x, spin.x), against(moment.y, spin.y), against(moment.z, spin.z) };
}

/// New spin of a body under a moment, and the works of damping and of what holds it.
///
/// @param undamped  spin that damping leaves alone
void integrate_turn(
    RigidBody& body, Vector moment, Vector undamped, const StepOptions& o, StepSums& sums)
{
    const Vector old = body.spin, momentum = body.angular_momentum;
    if (body.spin_held) {
        const double work = -0.5 * o.dt * dot(moment, old);
        sums.prescribed[0] += work;
        sums.prescribed_next[0] += work;
        const Vector own = turned(inverse(body.turn), body.spin);
        body.angular_momentum = turned(body.turn, body.inertia * own);
        return;
    }
    const Vector damp = damping_moment(moment, old - undamped, o.damping);
    body.angular_momentum = momentum + o.dt * (moment + damp);
    body.spin = spin_of(body, o.dt);
    sums.damped[0] -= 0.5 * o.dt * dot(damp, old);
    sums.damped_next[0] -= 0.5 * o.dt * dot(damp, body.spin);
    sums.dragged[0] -= 0.5 * o.dt * dot(damp, undamped);
    sums.kinetic[0] += 0.25 * (dot(old, body.angular_momentum) + dot(body.spin, momentum));
}

}  // namespace

void move_body(SolidState& s, int block, double dt)
{
    Grains& grains = s.grains;
    const int grain = grains.in_slot[block * lanes], centre = grains.centre(grain);
    RigidBody& body = s.bodies[grain];
    const Vector way =
        space_vector(grains.displacement, centre) + dt * space_vector(grains.velocity, centre);
    body.turn = normalized(rotation_by(dt * body.spin) * body.turn);
    place_body(s, grain, way);
}

void integrate_body(SolidState& s, int block, const StepOptions& o, StepSums& sums)
{
    Grains& grains = s.grains;
    const int grain = grains.in_slot[block * lanes], centre = grains.centre(grain);
    const Vector moment = moment_on(s, grain);
    Vector force;
    for (int n = 0; n < grains.vertices_of(grain); ++n)
        force = force + space_vector(grains.force, grains.node(grain, n));
    set_space_vector(grains.force, centre, force);
    const double inverse_mass = grains.inverse_mass[grains.scalar_index(centre)];
    const Array<double>& undamped = s.undamped().velocity;
    for (int axis = 0; axis < grains.layout.dimension; ++axis) {
        const int i = grains.component(centre, axis);
        integrate_one<true>({ grains.force[i], inverse_mass,
                                static_cast<double>(grains.prescribed[i]), undamped[i] },
            o.dt, o.damping, grains.velocity[i], sums, axis);
    }
    sums.largest[0] = std::max(sums.largest[0], norm(moment) / grains.radius[grain]);
    integrate_turn(s.bodies[grain], moment, spin_in(s.undamped(), grain), o, sums);
}

Vector moment_on(const SolidState& s, int grain)
{
    const Grains& grains = s.grains;
    const auto place = [&](int node) {
        return space_vector(grains.reference, node) + space_vector(grains.displacement, node);
    };
    const Vector middle = place(grains.centre(grain));
    Vector moment;
    for (int n = 0; n < grains.vertices_of(grain); ++n) {
        const int node = grains.node(grain, n);
        moment = moment + cross(place(node) - middle, space_vector(grains.force, node));
    }
    return moment;
}

void place_body(SolidState& s, int grain, Vector way)
{
    Grains& grains = s.grains;
    const Vector middle = space_vector(grains.reference, grains.centre(grain));
    for (int n = 0; n < grains.nodes_of(grain); ++n) {
        const int node = grains.node(grain, n);
        const Vector arm = space_vector(grains.reference, node) - middle;
        set_space_vector(grains.displacement, node, way + turned_by(s.bodies[grain].turn, arm));
    }
}

void set_spin(SolidState& s, int grain, Vector spin, bool held)
{
    RigidBody& body = s.bodies.at(grain);
    body.spin = spin;
    body.spin_held = held;
    body.angular_momentum = turned(body.turn, body.inertia * turned(inverse(body.turn), spin));
}

void set_motion(SolidState& s, int grain, Vector velocity, Vector spin)
{
    if (!s.grains.is_rigid(grain))
        refuse("grain", grain, "", "is deformable, must be rigid; write to its velocities instead");
    if (!is_finite(velocity) || !is_finite(spin)) {
        refuse("motion of grain " + std::to_string(grain), "no finite number",
            "must be a velocity [m/s] and a spin [rad/s]");
    }
    set_space_vector(s.grains.velocity, s.grains.centre(grain), velocity);
    set_spin(s, grain, spin, s.bodies[grain].spin_held);
}

double least_moment(const SpaceTensor& i)
{
    const Vector x { i.xx, i.xy, i.xz }, y { i.xy, i.yy, i.yz }, z { i.xz, i.yz, i.zz };
    const double trace = i.xx + i.yy + i.zz;
    // Gershgorin's circles; and the product of the others is at most a quarter of trace squared
    const double circles = std::min({ i.xx - std::fabs(i.xy) - std::fabs(i.xz),
        i.yy - std::fabs(i.xy) - std::fabs(i.yz), i.zz - std::fabs(i.xz) - std::fabs(i.yz) });
    return std::max(circles, 4.0 * triple(x, y, z) / (trace * trace));
}

}  // namespace flexpm
