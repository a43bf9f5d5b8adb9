// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/steady_motion.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/motion/rigid_grain.hpp>

namespace flexpm {

namespace {

Array<double> angles(const Grains& grains)
{
    Array<double> found(grains.spin.size(), 0.0);
    for (int g = 0; g < grains.count; ++g) {
        if (grains.is_rigid(g)) found[grains.slot[g]] = rotation_of(grains, g);
    }
    return found;
}

/// Of a rigid grain the centre alone has a velocity that counts.
void take_mean(Assembly& a, const Array<double>& angle, double time)
{
    Grains& grains = a.grains;
    const SteadyMotion& last = a.steady;
    const auto of_component = [&](int i) {
        if (!grains.prescribed[i])
            grains.loading_velocity[i] = (grains.displacement[i] - last.displacement[i]) / time;
    };
    for (int g = 0; g < grains.count; ++g) {
        if (grains.erased[g]) continue;
        if (!grains.is_rigid(g)) {
            for_each_component(grains, g, of_component);
            continue;
        }
        const int slot = grains.slot[g];
        for (int axis = 0; axis < dimension; ++axis)
            of_component(component(grains.centre(g), axis));
        if (!grains.spin_prescribed[slot])
            grains.loading_spin[slot] = (angle[slot] - last.angle[slot]) / time;
    }
}

}  // namespace

void follow_steady_motion(Assembly& a, double dt)
{
    check_positive("time step", dt, "s");
    const Array<double> angle = angles(a.grains);
    if (!a.steady.is_followed()) {
        a.steady.loading_velocity = a.grains.loading_velocity;
        a.steady.loading_spin = a.grains.loading_spin;
    } else if (a.step > a.steady.step) {
        take_mean(a, angle, static_cast<double>(a.step - a.steady.step) * dt);
    }
    a.steady.displacement = a.grains.displacement;
    a.steady.angle = angle;
    a.steady.step = a.step;
}

void end_steady_motion(Assembly& a)
{
    if (!a.steady.is_followed()) return;
    a.grains.loading_velocity = a.steady.loading_velocity;
    a.grains.loading_spin = a.steady.loading_spin;
    a.steady = {};
}

Array<double>& velocity_of_loading(Assembly& a)
{
    return a.steady.is_followed() ? a.steady.loading_velocity : a.grains.loading_velocity;
}

const Array<double>& velocity_of_loading(const Assembly& a)
{
    return a.steady.is_followed() ? a.steady.loading_velocity : a.grains.loading_velocity;
}

Array<double>& spin_of_loading(Assembly& a)
{
    return a.steady.is_followed() ? a.steady.loading_spin : a.grains.loading_spin;
}

const Array<double>& spin_of_loading(const Assembly& a)
{
    return a.steady.is_followed() ? a.steady.loading_spin : a.grains.loading_spin;
}

}  // namespace flexpm
