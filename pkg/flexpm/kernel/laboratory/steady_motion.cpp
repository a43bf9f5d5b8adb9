// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/steady_motion.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/plane_lanes/rigid_grain.hpp>

#include <algorithm>

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

/// A mean velocity that damping leaves alone, no faster than the bound.
Point bounded(Point velocity, double fastest)
{
    const double speed = norm(velocity);
    return speed > fastest ? (fastest / speed) * velocity : velocity;
}

/// Mean motion of the nodes since the last look; of a rigid grain the centre alone has a velocity
/// that counts.
class MeanMotion {
public:
    MeanMotion(Assembly& assembly, double time, double fastest) :
        a(assembly),
        time(time),
        fastest(fastest)
    {
    }

    void take(int node) const
    {
        Point mean =
            vector_at(a.grains.displacement, node) - vector_at(a.steady.displacement, node);
        mean = bounded({ mean.x / time, mean.y / time }, fastest);
        take(component(node, 0), mean.x);
        take(component(node, 1), mean.y);
    }

    /// The rim of a grain goes no faster than its centre may.
    void take_spin(int grain, double turn) const
    {
        const int slot = a.grains.slot[grain];
        const double most = fastest / a.grains.radius[grain];
        if (!a.grains.spin_prescribed[slot])
            a.steady.mean.spin[slot] = std::clamp(turn / time, -most, most);
    }

    void damp(int grain) const
    {
        damp_loose(a.grains, a.steady.mean, grain);
        if (a.grains.is_rigid(grain)) take_spin(grain, 0.0);
    }

private:
    void take(int i, double velocity) const
    {
        if (!a.grains.prescribed[i]) a.steady.mean.velocity[i] = velocity;
    }

    Assembly& a;
    const double time, fastest;
};

void take_mean(Assembly& a, const Array<double>& angle, double time, double fastest)
{
    const Grains& grains = a.grains;
    const MeanMotion mean(a, time, fastest);
    for (int g = 0; g < grains.count; ++g) {
        if (grains.erased[g]) continue;
        const int slot = grains.slot[g];
        if (grains.loose[g]) {
            mean.damp(g);
        } else if (grains.is_rigid(g)) {
            mean.take(grains.centre(g));
            mean.take_spin(g, angle[slot] - a.steady.angle[slot]);
        } else {
            for (int n = 0; n < grains.nodes_of(g); ++n)
                mean.take(grains.node(g, n));
        }
    }
}

}  // namespace

void follow_steady_motion(Assembly& a, double dt, double fastest)
{
    check_positive("time step", dt, "s");
    check_positive("fastest descent", fastest, "m/s");
    const Array<double> angle = angles(a.grains);
    if (!a.steady.is_followed()) {
        a.steady.mean = a.loading.grains;
    } else if (a.step > a.steady.step) {
        take_mean(a, angle, static_cast<double>(a.step - a.steady.step) * dt, fastest);
    }
    a.steady.displacement = a.grains.displacement;
    a.steady.angle = angle;
    a.steady.step = a.step;
}

void end_steady_motion(Assembly& a) { a.steady = {}; }

void damp_loose(const Grains& grains, GrainMotion& mean, int grain)
{
    for_each_component(grains, grain, [&](int i) {
        if (!grains.prescribed[i]) mean.velocity[i] = 0.0;
    });
}

}  // namespace flexpm
