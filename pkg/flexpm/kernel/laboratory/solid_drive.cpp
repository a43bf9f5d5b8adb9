// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/solid_drive.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/laboratory/solid_frame.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/parts/node_sets.hpp>
#include <flexpm/kernel/parts/plate_loading.hpp>
#include <flexpm/kernel/parts/solid_plates.hpp>
#include <flexpm/kernel/space_lanes/solid_access.hpp>
#include <flexpm/kernel/space_lanes/solid_bodies.hpp>

#include <algorithm>

namespace flexpm {

namespace {

void set_velocity(SolidState& s, const SolidDrive& drive, double velocity, double dt)
{
    for (int plate : drive.plates) {
        let_go(s.plates[plate]);
        s.plates[plate].velocity = velocity * drive.direction;
    }
    drive.for_each_set([&](int set, double sense) {
        const Vector rate = sense * velocity * drive.direction;
        set_motion_of(s, set, drive.turns ? Vector {} : rate, drive.turns ? rate : Vector {});
    });
    drive_node_sets(s, dt);
    if (drive.moves_top()) prescribe(s, side_nodes(s, SolidSide::top), z_axis, velocity);
}

/// Part of the way of its crosshead that a driven plate goes, by a linear solution [-]: 1 without a
/// soft machine.
/// @throws std::invalid_argument  if one of several driven plates has a soft machine
double way_of_plate(const SolidState& s, const SolidDrive& drive, const SolidField& field)
{
    for (int plate : drive.plates) {
        const double machine = s.plates[plate].machine_stiffness;
        if (!(machine > 0.0)) continue;
        if (drive.plates.size() > 1)
            refuse("driven plates with a soft machine", static_cast<double>(drive.plates.size()),
                "", "must be 1");
        return machine / (machine + field.load / drive.length);
    }
    return 1.0;
}

/// Let damping act on all motion.
void forget_loading(SolidState& s)
{
    std::fill(s.loading.grains.velocity.begin(), s.loading.grains.velocity.end(), 0.0);
    std::fill(s.loading.grains.spin.begin(), s.loading.grains.spin.end(), 0.0);
    s.loading.plates.clear();
    s.loading.sets.clear();
}

/// Bring what moves with the loading to `ratio` times that motion.
void change_loading(SolidState& s, double ratio, double dt)
{
    Grains& grains = s.grains;
    GrainMotion& given = s.loading.grains;
    for (std::size_t i = 0; i < given.velocity.size(); ++i) {
        if (!grains.prescribed[i]) grains.velocity[i] += (ratio - 1.0) * given.velocity[i];
        given.velocity[i] *= ratio;
    }
    for (int g = 0; g < static_cast<int>(s.bodies.size()); ++g) {
        const Vector spin = spin_in(given, g);
        if (!s.bodies[g].spin_held) set_spin(s, g, s.bodies[g].spin + (ratio - 1.0) * spin, false);
        set_space_vector(given.spin, 3 * g, ratio * spin);
    }
    for (std::size_t i = 0; i < s.loading.plates.size(); ++i) {
        Vector& own = s.loading.plates[i].velocity;
        s.plates[i].velocity = s.plates[i].velocity + (ratio - 1.0) * own;
        own = ratio * own;
    }
    for (std::size_t i = 0; i < s.loading.sets.size(); ++i) {
        Vector& own = s.loading.sets[i].velocity;
        s.node_sets[i].velocity = s.node_sets[i].velocity + (ratio - 1.0) * own;
        own = ratio * own;
    }
    if (!s.loading.sets.empty()) drive_node_sets(s, dt);
}

void check(double velocity, double dt)
{
    check_finite("velocity of what loads", velocity, "m/s");
    check_positive("time step", dt, "s");
}

}  // namespace

SolidDrive drive_of_top(const SolidState& s)
{
    SolidDrive drive;
    drive.length = end_place(s, SolidSide::top) - end_place(s, SolidSide::bottom);
    const int plate = find_plate(s, SolidSide::top);
    if (plate >= 0) drive.plates = { plate };
    return drive;
}

void start(SolidState& s, const SolidDrive& drive, const SolidField& field, double part,
    double velocity, bool undamped, double dt)
{
    check(velocity, dt);
    check_finite("part of the field", part, "");
    const double of_way = way_of_plate(s, drive, field);
    for (std::size_t i = 0; i < s.plates.size(); ++i) {
        Plate& plate = s.plates[i];
        const PlateMotion motion = field.of_plate(i);
        plate.displacement = {};
        if (plate.loaded) plate.displacement = of_way * part * motion.way * plate.normal;
        if (plate.seated) plate.turn = plate.turn + of_way * part * motion.turn;
    }
    const Vector way = part * drive.length * drive.direction;
    for (int number : drive.plates) {
        Plate& plate = s.plates[number];
        plate.displacement = of_way * way;
        if (plate.machine_stiffness > 0.0)
            plate.machine_give = dot(plate.normal, way - plate.displacement);
    }
    drive.for_each_set([&](int set, double sense) {
        NodeSet& moved = s.node_sets[set];
        (drive.turns ? moved.angle : moved.displacement) = sense * way;
    });
    for (std::size_t i = 0; i < field.sets.size(); ++i) {
        if (!s.node_sets[i].floats) continue;
        s.node_sets[i].displacement = part * field.sets[i];
        s.node_sets[i].pivot = s.node_sets[i].pivot + part * field.sets[i];
    }
    set_velocity(s, drive, velocity, dt);
    begin_from(s, field, of_way * part, of_way * velocity / drive.length);
    promise_work(s, dt);
    if (!undamped) forget_loading(s);
}

void take_over(SolidState& s, const SolidDrive& drive, const SolidField& field, double velocity,
    bool undamped, double dt)
{
    check(velocity, dt);
    const double before = kinetic_of_velocities(s);
    set_velocity(s, drive, velocity, dt);
    add_motion(s, field, way_of_plate(s, drive, field) * velocity / drive.length);
    if (!field.sets.empty()) drive_node_sets(s, dt);  // those that float have got a velocity
    promise_work(s, dt);
    s.ledger.prescribed_work[0] += kinetic_of_velocities(s) - before;
    if (!undamped) forget_loading(s);
}

void set_off(SolidState& s, const SolidDrive& drive, double velocity, double dt)
{
    check(velocity, dt);
    set_velocity(s, drive, velocity, dt);
    if (s.step == 0) begin_balance(s);
    promise_work(s, dt);
}

void go_on(SolidState& s, const SolidDrive& drive, double velocity, double dt)
{
    check(velocity, dt);
    const double old = velocity_of(s, drive);
    if (velocity == old) return;
    set_velocity(s, drive, velocity, dt);
    if (old != 0.0) {
        const double before = kinetic_of_velocities(s);
        change_loading(s, velocity / old, dt);
        s.ledger.prescribed_work[0] += kinetic_of_velocities(s) - before;
    }
    promise_work(s, dt);
}

Array<double> loading_field(const SolidState& s)
{
    const Grains& grains = s.grains;
    Array<double> field = s.loading.grains.velocity;
    for (int g = 0; g < grains.count; ++g) {
        if (!grains.is_rigid(g)) continue;
        const int centre = grains.centre(g);
        const Vector velocity = space_vector(field, centre), spin = spin_in(s.loading.grains, g);
        for (int n = 0; n < grains.vertices_of(g); ++n) {
            const int node = grains.node(g, n);
            const Vector arm = grains.position(node) - grains.position(centre);
            set_space_vector(field, node, velocity + cross(spin, arm));
        }
    }
    for (std::size_t i = 0; i < field.size(); ++i)
        if (grains.prescribed[i]) field[i] = grains.velocity[i];
    return field;
}

double velocity_of(const SolidState& s, const SolidDrive& drive)
{
    if (!drive.plates.empty()) return dot(s.plates[drive.plates.front()].velocity, drive.direction);
    if (!drive.sets.empty()) {
        const NodeSet& first = s.node_sets[drive.sets.front()];
        return dot(drive.turns ? first.spin : first.velocity, drive.direction);
    }
    return s.grains.velocity[s.grains.component(side_nodes(s, SolidSide::top).front(), z_axis)];
}

}  // namespace flexpm
