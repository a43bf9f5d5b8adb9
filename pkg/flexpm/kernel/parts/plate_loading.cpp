// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/parts/plate_loading.hpp>

#include <flexpm/kernel/assembly/loose_groups.hpp>
#include <flexpm/kernel/core/central_difference.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/parts/plate_points.hpp>

#include <string>

namespace flexpm {

namespace {

Plate& plate_at(BondedState& state, int plate)
{
    require_plate(state, plate);
    return state.plates[plate];
}

}  // namespace

void require_plate(const BondedState& state, int plate)
{
    if (plate < 0 || plate >= static_cast<int>(state.plates.size()))
        refuse("plate", plate, "", "must be the index of a plate; add one first");
}

int find_plate(const BondedState& state, int side)
{
    for (std::size_t i = 0; i < state.plates.size(); ++i)
        if (state.plates[i].side == side) return static_cast<int>(i);
    return -1;
}

Vector plate_force(const BondedState& state, int side)
{
    Vector sum;
    for (const Plate& p : state.plates)
        if (p.side == side) sum = sum + p.force;
    return sum;
}

void set_velocity(BondedState& state, int plate, Vector velocity)
{
    Plate& p = plate_at(state, plate);
    check_finite("velocity of a plate", velocity.x, "m/s");
    check_finite("velocity of a plate", velocity.y, "m/s");
    check_finite("velocity of a plate", velocity.z, "m/s");
    let_go(p);
    p.velocity = velocity;
}

void free_plate(SolidState& s, int plate)
{
    Plate& p = plate_at(s, plate);
    if (!(p.face_area > 0.0) || is_jaw(p))
        refuse(
            "area of a plate", p.face_area, "m^2", "must be > 0; place it on a part of the side");
    if (p.loaded) return;
    p.loaded = true;
    p.load = dot(p.normal, p.force);  // it stays where it is until a pressure acts
    p.velocity = {};
}

void press(Assembly& a, int plate, double pressure)
{
    Plate& p = plate_at(a, plate);
    check_not_negative("pressure on a plate", pressure, "Pa");
    if (p.mass <= 0.0) refuse("mass of a plate", p.mass, "kg", "must be above 0; scale the masses");
    p.loaded = true;
    p.load = a.area_of(pressure * p.width);
}

void press(SolidState& s, int plate, double pressure)
{
    Plate& p = plate_at(s, plate);
    check_not_negative("pressure on a plate", pressure, "Pa");
    if (!(p.loaded && p.mass > 0.0)) {
        refuse("mass of a plate", p.mass, "kg",
            "must be above 0; let a load move it, and scale the masses");
    }
    p.load = pressure * p.face_area;
}

void set_machine(BondedState& state, int plate, double stiffness)
{
    Plate& p = plate_at(state, plate);
    check_positive("stiffness of a machine", stiffness, "N/m");
    if (p.machine_stiffness > 0.0) {
        refuse("stiffness of a machine", stiffness, "N/m",
            "must be given once, was " + number(p.machine_stiffness) + " N/m");
    }
    p.machine_stiffness = stiffness;
    p.machine_give = dot(p.normal, p.force) / stiffness;
}

void integrate_loaded(BondedState& state, std::size_t number, const std::vector<int>& grain_of,
    double dt, double damping)
{
    Plate& plate = state.plates[number];
    const bool bears = bears_any(plate, grain_of, state.grains);
    const double undamped = dot(plate.normal, state.loading.of_plate(number).velocity);
    const double load = bears ? plate.load : 0.0;
    const double net = load - dot(plate.normal, plate.force);
    double speed = dot(plate.normal, plate.velocity);
    const double old = speed;
    StepSums sums;
    integrate_one<true>({ net, 1.0 / plate.mass, 0.0, undamped }, dt, damping, speed, sums, 0);
    plate.velocity = speed * plate.normal;
    plate.damping_work += plate.damping_work_next + sums.damped[0];
    plate.damping_work_next = sums.damped_next[0];
    plate.drag_work += plate.drag_work_next + sums.dragged[0];
    plate.drag_work_next = sums.dragged[0];
    plate.boundary_work += plate.boundary_work_next + 0.5 * dt * load * old;
    plate.boundary_work_next = 0.5 * dt * load * speed;
    plate.kinetic = sums.kinetic[0];
    plate.unbalanced = bears ? sums.largest[0] : plate.load;
}

void let_go(Plate& plate)
{
    if (!plate.loaded) return;
    plate.boundary_work_next = plate.damping_work_next = plate.drag_work_next = 0.0;
    plate.kinetic = plate.unbalanced = 0.0;
    plate.loaded = false;
}

}  // namespace flexpm
