// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/steady_motion.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/plane_lanes/rigid_grain.hpp>

#include <algorithm>
#include <cmath>

namespace flexpm {

namespace {

constexpr int quaternion_values = 4;  ///< of the turn of a polyhedron in SteadyMotion::angle

/// Angles of rigid grains, in the layout of SteadyMotion::angle.
Array<double> angles_of(const Assembly& a)
{
    const Grains& grains = a.grains;
    Array<double> found(grains.spin.size(), 0.0);
    for (int g = 0; g < grains.count; ++g) {
        if (grains.is_rigid(g)) found[grains.slot[g]] = rotation_of(grains, g);
    }
    return found;
}

Array<double> angles_of(const SolidState& s)
{
    Array<double> found;
    for (const RigidBody& body : s.bodies)
        found.insert(found.end(), { body.turn.w, body.turn.v.x, body.turn.v.y, body.turn.v.z });
    return found;
}

/// Small turn from one rotation to another as a vector [rad].
Vector turn_between(const Quaternion& from, const Quaternion& to)
{
    const Quaternion between = to * inverse(from);
    const double sine = norm(between.v);
    if (sine == 0.0) return {};
    const double half = std::atan2(sine, std::fabs(between.w));
    return ((between.w < 0.0 ? -2.0 : 2.0) * half / sine) * between.v;
}

/// A mean velocity that damping leaves alone, no faster than the bound.
Vector bounded(const Grains& grains, Vector velocity, double fastest)
{
    const double speed = grains.length(velocity);
    return speed > fastest ? (fastest / speed) * velocity : velocity;
}

/// Mean velocity over a time. The two ways to divide differ in the last digit, which results keep.
Vector mean_over(const Grains& grains, Vector way, double time)
{
    if (grains.layout.dimension == 2) return { way.x / time, way.y / time, 0.0 };
    return (1.0 / time) * way;
}

/// Give a rigid grain the mean spin of its turn, whose rim goes no faster than its centre may.
void take_spin(Assembly& a, const Array<double>& angle, int grain, double time, double fastest)
{
    const int slot = a.grains.slot[grain];
    const double most = fastest / a.grains.radius[grain];
    const double turn = angle[slot] - a.steady.angle[slot];
    a.steady.mean.spin[slot] = std::clamp(turn / time, -most, most);
}

void take_spin(SolidState& s, const Array<double>& angle, int grain, double time, double fastest)
{
    const auto read = [&](const Array<double>& values) {
        const double* v = &values[quaternion_values * grain];
        return Quaternion { v[0], { v[1], v[2], v[3] } };
    };
    const Vector turn = turn_between(read(s.steady.angle), read(angle));
    set_space_vector(s.steady.mean.spin, 3 * grain,
        bounded(s.grains, (1.0 / time) * turn, fastest / s.grains.radius[grain]));
}

void end_spin(Assembly& a, int grain) { a.steady.mean.spin[a.grains.slot[grain]] = 0.0; }
void end_spin(SolidState& s, int grain) { set_space_vector(s.steady.mean.spin, 3 * grain, {}); }

/// Take the mean motion since the last look; of a rigid grain the centre alone has a velocity that
/// counts.
template <class State>
void take_mean(State& s, const Array<double>& angle, double time, double fastest)
{
    const Grains& grains = s.grains;
    SteadyMotion& steady = s.steady;
    const auto take = [&](int node) {
        const Vector way =
            grains.vector(grains.displacement, node) - grains.vector(steady.displacement, node);
        const Vector mean = bounded(grains, mean_over(grains, way, time), fastest);
        const double values[] = { mean.x, mean.y, mean.z };
        for (int axis = 0; axis < grains.layout.dimension; ++axis) {
            const int i = grains.component(node, axis);
            if (!grains.prescribed[i]) steady.mean.velocity[i] = values[axis];
        }
    };
    for (int g = 0; g < grains.count; ++g) {
        if (grains.erased[g]) continue;
        const bool turns = grains.is_rigid(g) && !s.is_spin_held(g);
        if (grains.loose[g]) {
            for_each_component(grains, g, [&](int i) {
                if (!grains.prescribed[i]) steady.mean.velocity[i] = 0.0;
            });
            if (turns) end_spin(s, g);
        } else if (grains.is_rigid(g)) {
            take(grains.centre(g));
            if (turns) take_spin(s, angle, g, time, fastest);
        } else {
            for (int n = 0; n < grains.nodes_of(g); ++n)
                take(grains.node(g, n));
        }
    }
}

}  // namespace

template <class State> void follow_steady_motion(State& s, double dt, double fastest)
{
    check_positive("time step", dt, "s");
    check_positive("fastest descent", fastest, "m/s");
    const Array<double> angle = angles_of(s);
    if (!s.steady.is_followed()) {
        s.steady.mean = s.loading.grains;
    } else if (s.step > s.steady.step) {
        take_mean(s, angle, static_cast<double>(s.step - s.steady.step) * dt, fastest);
    }
    s.steady.displacement = s.grains.displacement;
    s.steady.angle = angle;
    s.steady.step = s.step;
}

template void follow_steady_motion(Assembly& s, double dt, double fastest);
template void follow_steady_motion(SolidState& s, double dt, double fastest);

void end_steady_motion(BondedState& s) { s.steady = {}; }

}  // namespace flexpm
