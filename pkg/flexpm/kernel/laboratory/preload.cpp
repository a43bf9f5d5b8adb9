// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/preload.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/laboratory/end_displacement.hpp>
#include <flexpm/kernel/laboratory/loading_motion.hpp>
#include <flexpm/kernel/laboratory/softening_ahead.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>

#include <cmath>

namespace flexpm {

void preload(Assembly& a, double share, int steps, double dt)
{
    if (!(share > 0.0 && share < 1.0)) {
        refuse("share of the elastic limit", share, "", "must be above 0 and below 1");
    }
    if (steps < 1) refuse("steps to the elastic limit", steps, "", "must be at least 1");
    const Array<double> velocity = elastic_velocities(a);
    const double factor = share * elastic_time(a, velocity) / (steps * dt);
    check_positive("velocity to the elastic limit over that of the test", factor, "");
    for_each_component(a.grains, [&](int i) {
        a.grains.prescribed[i] = 1;
        a.grains.velocity[i] = factor * velocity[i];
    });
}

void release_preload(Assembly& a, double velocity, double dt, bool undamped)
{
    need_sides(a);
    const double now = a.grains.velocity[component(side_nodes(a, top_side).front(), 1)];
    check_finite("velocity after the preload", velocity, "m/s");
    if (!(std::isfinite(now) && now != 0.0)) {
        refuse("velocity of the preload", now, "m/s", "must not be 0; preload the specimen first");
    }
    for_each_component(a.grains, [&](int i) { a.grains.velocity[i] *= velocity / now; });
    update_prescribed_work(a, dt);
    for_each_component(a.grains, [&](int i) { a.grains.prescribed[i] = 0; });
    grip_bottom(a);
    move_top(a, velocity);
    for_each_component(a.grains, [&](int i) {
        if (undamped && !a.grains.prescribed[i])
            a.loading.grains.velocity[i] = a.grains.velocity[i];
    });
    a.ledger.prescribed_work[0] += kinetic_of_velocities(a.grains);
}

}  // namespace flexpm
