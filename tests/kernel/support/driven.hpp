// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Assemblies whose nodes are all held and led along a prescribed motion. SI units.
#pragma once

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/plane_lanes/rigid_grain.hpp>
#include <flexpm/kernel/step/solid_step.hpp>
#include <flexpm/kernel/step/step.hpp>

#include "support/specimens.hpp"

namespace driven {

using flexpm::Assembly;
using flexpm::component;
using flexpm::lanes;
using flexpm::Point;
using flexpm::set_vector;
using flexpm::vector_at;

inline void hold_all(Assembly& a)
{
    std::fill(a.grains.prescribed.begin(), a.grains.prescribed.end(), 1);
}

/// Velocity of every node of a grain from its reference position, velocity(Point) [m/s].
template <class Velocity> void set_velocity(Assembly& a, int grain, Velocity velocity)
{
    for (int n = 0; n < a.grains.nodes_of(grain); ++n) {
        const int i = a.grains.node(grain, n);
        const Point v = velocity(vector_at(a.grains.reference, i));
        a.grains.velocity[i] = v.x;
        a.grains.velocity[component(i, 1)] = v.y;
    }
}

inline void set_velocity(Assembly& a, int grain, Point v)
{
    set_velocity(a, grain, [v](Point) { return v; });
}

/// Give a rigid grain a spin [rad/s] that no moment changes.
inline void prescribe_spin(flexpm::Grains& grains, int grain, double spin)
{
    const Point velocity = vector_at(grains.velocity, grains.centre(grain));
    flexpm::set_motion(grains, grain, velocity, spin, 1.0);
    grains.spin_prescribed[grains.slot[grain]] = 1;
}

/// Velocities that bring every node in one step of `dt` to target(node offset).
template <class Target> void aim(Assembly& a, double dt, Target target)
{
    for (int g = 0; g < a.grains.count; ++g) {
        for (int n = 0; n < a.grains.nodes_of(g); ++n) {
            const int i = a.grains.node(g, n);
            const Point now = a.grains.point_at(i), then = target(i);
            a.grains.velocity[i] = (then.x - now.x) / dt;
            a.grains.velocity[component(i, 1)] = (then.y - now.y) / dt;
        }
    }
}

inline void run(Assembly& a, int steps, double damping = 0.0)
{
    flexpm::StepOptions options;
    options.damping = damping;
    for (int i = 0; i < steps; ++i)
        flexpm::step(a, options);
}

/// Steps the last of which is measured.
template <class State> void run_measured(State& s, int steps, double damping = 0.7, double dt = 1.0)
{
    flexpm::StepOptions options;
    options.damping = damping;
    options.dt = dt;
    for (int i = 0; i < steps; ++i) {
        options.measure = i + 1 == steps;
        flexpm::step(s, options);
    }
}

/// Force of a contact on the node of its side (0: a, 1: b) and end (0, 1) [N].
inline Point contact_force(const Assembly& a, int contact, int side, int end)
{
    const double* f = &a.contacts.forces[flexpm::Contacts::force_index(contact, side, end)];
    return { f[0], f[1] };
}

/// Resultant of a contact on its first grain [N]: along x positive in tension if the normal is +x.
inline Point resultant(const Assembly& a, int contact)
{
    const Point f0 = contact_force(a, contact, 0, 0), f1 = contact_force(a, contact, 0, 1);
    return { f0.x + f1.x, f0.y + f1.y };
}

}  // namespace driven
