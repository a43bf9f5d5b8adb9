// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/preload.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/laboratory/end_displacement.hpp>
#include <flexpm/kernel/laboratory/loading_motion.hpp>
#include <flexpm/kernel/laboratory/softening_ahead.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/parts/node_sets.hpp>
#include <flexpm/kernel/space_lanes/solid_bodies.hpp>

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace flexpm {

namespace {

template <class State> constexpr bool is_solid = std::is_same_v<State, SolidState>;

void check(const PreloadPath& path)
{
    if (!(path.share > 0.0 && path.share < 1.0)) {
        refuse("share of the elastic limit", path.share, "", "must be above 0 and below 1");
    }
    if (path.steps < 1) refuse("steps to the elastic limit", path.steps, "", "must be at least 1");
}

/// @param now  velocity of the top along the elastic solution [m/s]
void check_release(double velocity, double now)
{
    check_finite("velocity after the preload", velocity, "m/s");
    if (!(std::isfinite(now) && now != 0.0)) {
        refuse("velocity of the preload", now, "m/s", "must not be 0; preload the specimen first");
    }
}

/// Hold all components and spins at their velocities. Returns the components that were held.
template <class State> std::vector<int> hold_all(State& s)
{
    std::vector<int> held;
    for_each_component(s.grains, [&](int i) {
        if (s.grains.prescribed[i]) held.push_back(i);
        s.grains.prescribed[i] = 1;
    });
    if constexpr (is_solid<State>)
        for (RigidBody& body : s.bodies)
            body.spin_held = true;
    return held;
}

/// Undo that.
template <class State> void let_go(State& s, const std::vector<int>& held)
{
    for_each_component(s.grains, [&](int i) { s.grains.prescribed[i] = 0; });
    for (int i : held)
        s.grains.prescribed.at(i) = 1;
    if constexpr (is_solid<State>)
        for (RigidBody& body : s.bodies)
            body.spin_held = false;
}

template <class State> void scale_velocities(State& s, double ratio)
{
    for_each_component(s.grains, [&](int i) { s.grains.velocity[i] *= ratio; });
    if constexpr (is_solid<State>)
        for (int g = 0; g < static_cast<int>(s.bodies.size()); ++g)
            set_spin(s, g, ratio * s.bodies[g].spin, s.bodies[g].spin_held);
}

/// @throws std::invalid_argument  for what is held or moves by itself besides the grains
void need_ends_alone(const SolidState& s)
{
    const auto loaded = [](const Plate& plate) { return plate.loaded || plate.seated; };
    const auto parts = s.node_sets.size() + s.held_faces.size()
        + static_cast<std::size_t>(std::count_if(s.plates.begin(), s.plates.end(), loaded));
    if (parts > 0) {
        refuse("parts that are free to move or fix grains", static_cast<double>(parts), "",
            "must be 0 for a preload; leave it out");
    }
}

}  // namespace

std::vector<int> preload(Assembly& a, const PreloadPath& path)
{
    check(path);
    const Array<double> velocity = elastic_velocities(a);
    const double factor = path.share * elastic_time(a, velocity) / (path.steps * path.dt);
    check_positive("velocity to the elastic limit over that of the test", factor, "");
    for_each_component(a.grains, [&](int i) { a.grains.velocity[i] = factor * velocity[i]; });
    return hold_all(a);
}

std::vector<int> preload(SolidState& s, const SolidDrive& drive, const SolidField& field,
    double sense, const PreloadPath& path)
{
    check(path);
    need_ends_alone(s);
    const double strain = path.share * elastic_strain_left(s, field, sense);
    if (!(std::isfinite(strain) && strain > 0.0)) {
        refuse("strain to the elastic limit", strain, "",
            "must be above 0 and finite: no contact point may have softened; start at rest");
    }
    const double velocity = sense * strain * drive.length / (path.steps * path.dt);
    s.ledger.prescribed_work[0] -= kinetic_of_velocities(s);  // what pressures have left stops
    scale_velocities(s, 0.0);
    take_over(s, drive, field, velocity, false, path.dt);
    s.ledger.prescribed_work[0] -= kinetic_of_velocities(s);  // of all that is held from now on
    std::vector<int> held = hold_all(s);
    if (s.step == 0) begin_balance(s);
    promise_work(s, path.dt);
    return held;
}

void release_preload(
    Assembly& a, const std::vector<int>& held, double velocity, double dt, bool undamped)
{
    need_sides(a);
    const double now = a.grains.velocity[component(side_nodes(a, top_side).front(), 1)];
    check_release(velocity, now);
    scale_velocities(a, velocity / now);
    update_prescribed_work(a, dt);
    let_go(a, held);
    move_top(a, velocity);
    for_each_component(a.grains, [&](int i) {
        if (undamped && !a.grains.prescribed[i])
            a.loading.grains.velocity[i] = a.grains.velocity[i];
    });
    a.ledger.prescribed_work[0] += kinetic_of_velocities(a.grains);
}

void release_preload(SolidState& s, const SolidDrive& drive, const std::vector<int>& held,
    double velocity, double dt, bool undamped)
{
    const double now = velocity_of(s, drive);
    check_release(velocity, now);
    scale_velocities(s, velocity / now);
    let_go(s, held);
    for (std::size_t i = 1; i < s.ledger.prescribed_work.size(); i += 2)
        s.ledger.prescribed_work[i] = 0.0;  // of spins, too, that are free again
    go_on(s, drive, velocity, dt);          // to its last bit
    promise_work(s, dt);
    if (undamped) {
        s.loading.grains.velocity = s.grains.velocity;
        for (int g = 0; g < static_cast<int>(s.bodies.size()); ++g)
            set_space_vector(s.loading.grains.spin, 3 * g, s.bodies[g].spin);
    }
    s.ledger.prescribed_work[0] += kinetic_of_velocities(s);
}

}  // namespace flexpm
