// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Nodes of a solid that are held or moved as one: what they bear, their work, refusals.
#include "support/catch.hpp"

#include <flexpm/kernel/laboratory/solid_drive.hpp>
#include <flexpm/kernel/laboratory/solid_parts.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/parts/node_sets.hpp>
#include <flexpm/kernel/parts/solid_patches.hpp>
#include <flexpm/kernel/space_lanes/solid_access.hpp>
#include <flexpm/kernel/step/solid_masses.hpp>
#include <flexpm/kernel/step/solid_step.hpp>

#include "support/solid_states.hpp"

#include <limits>

using namespace solid_states;

namespace {

constexpr double damping = 0.7, dt = 1.0, a = solid_samples::side;
constexpr Vector up { 0.0, 0.0, 1.0 };
constexpr std::array<bool, 3> all { true, true, true };

SolidState made(const Packing& p, bool rigid)
{
    return make_solid(p.cells, p.solid, granite(FacePointRule::corners_and_inner, rigid));
}

/// Nodes that a set may hold between two heights.
std::vector<int> between(const SolidState& s, double low, double high)
{
    std::vector<int> found;
    for (int n : holdable_nodes(s)) {
        const double z = space_vector(s.grains.reference, n).z;
        if (z >= low && z <= high) found.push_back(n);
    }
    return found;
}

void go(SolidState& s, int steps)
{
    for (int k = 0; k < steps; ++k)
        step(s, { dt, damping, 1, true });
}

double imbalance(const Energies& e)
{
    return e.kinetic + e.elastic + e.damage + e.friction + e.damping + e.drag - e.boundary_work
        - e.initial;
}

}  // namespace

TEST_CASE("Sets that pull or twist a solid bear the same, and their work is that of the ledger",
    "[solids]")
{
    const Packing p = packing(60, 5);
    const double height = p.solid.high.z;
    const bool rigid = GENERATE(false, true), twist = GENERATE(false, true);
    SolidState s = made(p, rigid);
    const int low = add_node_set(s, between(s, -a, 0.2 * height), all);
    const int high = add_node_set(s, between(s, 0.8 * height, height + a), all);
    for (const int set : { low, high })
        if (twist) set_pivot(s, set, { 0.4 * p.solid.high.x, 0.5 * p.solid.high.y, 0.0 });
    scale_masses(s, damping, dt);
    const PartGeometry parts = twist
        ? PartGeometry { {}, {}, {}, 1.0, 1.0, { high }, { low }, {}, up }
        : PartGeometry { {}, {}, up, 1.0, 1.0, { high }, {}, { low } };
    const SolidDrive drive = drive_of(parts);
    const double velocity = twist ? 1e-8 : 1e-8 * height;
    const double stiffness = solid_part_scales(s, parts, 1e6, dt).modulus;
    start(s, drive, elastic_field(s, drive), 0.0, velocity, true, dt);
    CHECK(velocity_of(s, drive) == velocity);
    go(s, 400);
    const AxialObservation now = observe(s, part_frame(s, parts));
    const double way = 400.0 * velocity;
    CHECK(now.axial_strain == Approx(way).epsilon(1e-12));
    // the motion is that of the elastic solution: no wave, the same at both ends; the load of a
    // twist is the sum of both moments
    INFO(twist << rigid << " " << now.axial_stress / (stiffness * way));
    CHECK(now.axial_stress == Approx(stiffness * way).epsilon(2e-3));
    const NodeSet &top = s.node_sets[high], &base = s.node_sets[low];
    if (twist) {
        CHECK(base.angle.z == Approx(-way).epsilon(1e-12));
        CHECK(top.moment.z == Approx(-base.moment.z).epsilon(2e-3));
    } else {
        CHECK(now.end_mismatch < 2e-3);
        CHECK(top.force.z == Approx(-base.force.z).epsilon(2e-3));
        CHECK(base.work == 0.0);
    }
    const Energies e = energies(s);
    CHECK(std::fabs(imbalance(e)) < 1e-9 * e.elastic);
    const double work = top.work + base.work;
    CHECK(work == Approx(0.5 * stiffness * way * way).epsilon(5e-3));
    CHECK(e.boundary_work == Approx(work).epsilon(1e-9));
    // back at the same speed: the forces go back, too
    go_on(s, drive, -velocity, dt);
    go(s, 400);
    const AxialObservation back = observe(s, part_frame(s, parts));
    CHECK(std::fabs(back.axial_stress) < 2e-3 * now.axial_stress);
    CHECK(std::fabs(imbalance(energies(s))) < 1e-8 * e.elastic);
}

TEST_CASE("A set that floats bears a moment alone, which is the same all along", "[solids]")
{
    const Packing p = packing(80, 5);
    const double height = p.solid.high.z;
    const Vector about { 1.0, 0.0, 0.0 };
    const bool rigid = GENERATE(false, true), both = GENERATE(false, true);
    SolidState s = made(p, rigid);
    const int low = add_node_set(s, between(s, -a, 0.2 * height), all);
    const int high = add_node_set(s, between(s, 0.8 * height, height + a), all);
    let_float(s, high);
    if (both) let_float(s, low);
    scale_masses(s, damping, dt);
    const double between_pivots = s.node_sets[high].pivot.z - s.node_sets[low].pivot.z;
    std::vector<int> back;
    if (both) back.push_back(low);
    const PartGeometry parts { {}, {}, {}, 1.0, 1.0, { high }, back, {}, about };
    const SolidDrive drive = drive_of(parts);
    const double spin = 1e-9;
    const double stiffness = solid_part_scales(s, parts, 1e6, dt).modulus;
    const SolidField field = elastic_field(s, drive);
    start(s, drive, field, 0.0, spin, true, dt);
    const double motion = energies(s).kinetic;
    // the end of a beam goes half of the angle times the length between the sets
    const Vector way = field.of_set(high) - field.of_set(low);
    CHECK(std::fabs(way.y + (both ? 0.0 : 0.5) * between_pivots) < 0.15 * between_pivots);
    CHECK(s.node_sets[high].velocity.y == spin * field.of_set(high).y);
    go(s, 400);
    const NodeSet &held = s.node_sets[low], &turned = s.node_sets[high];
    const double angle = 400.0 * spin;
    CHECK(turned.angle.x == Approx(angle).epsilon(1e-12));
    CHECK(norm(turned.displacement - angle * field.of_set(high)) < 5e-3 * angle * between_pivots);
    CHECK(part_load(s, parts) == Approx(stiffness * angle).epsilon(2e-3));
    CHECK(held.moment.x == Approx(-turned.moment.x).epsilon(5e-3));
    CHECK(norm(turned.force) * height < 5e-3 * turned.moment.x);
    CHECK(norm(held.force) * height < 5e-3 * turned.moment.x);
    const Energies e = energies(s);
    CHECK(std::fabs(imbalance(e)) < 1e-9 * e.elastic);
    CHECK(e.boundary_work == Approx(turned.work + held.work).epsilon(1e-9));
    CHECK(e.kinetic == Approx(motion).epsilon(0.05));
    // another velocity takes it along, and raises no wave
    go_on(s, drive, 2.0 * spin, dt);
    CHECK(
        turned.velocity.y == Approx(2.0 * spin * field.of_set(high).y).epsilon(0.02).margin(1e-16));
    go(s, 200);
    CHECK(part_load(s, parts) == Approx(2.0 * stiffness * angle).epsilon(2e-3));
    CHECK(std::fabs(imbalance(energies(s))) < 1e-8 * e.elastic);
    CHECK_THROWS_WITH(let_float(s, 9), Catch::Contains("node set"));
}

TEST_CASE("A set that turns far takes its nodes around its pivot", "[solids]")
{
    const Packing p = packing(40, 5);
    SolidState s = made(p, false);
    const int set = add_node_set(s, between(s, -a, p.solid.high.z + a), all);
    const Vector pivot { 0.001, -0.002, 0.003 }, axis = (1.0 / 3.0) * Vector { 1.0, 2.0, 2.0 };
    const double steps = 50.0, angle = 2.0;
    set_pivot(s, set, pivot);
    scale_masses(s, damping, dt);
    set_motion_of(s, set, {}, (angle / steps) * axis);
    drive_node_sets(s, dt);
    promise_work(s, dt);
    go(s, static_cast<int>(steps));
    const Quaternion turn = rotation_by(angle * axis);
    for (const int n : s.node_sets[set].nodes) {
        const Vector there = space_vector(s.grains.reference, n);
        const Vector off = s.grains.position(n) - pivot - turned(turn, there - pivot);
        CHECK(norm(off) < 1e-12 * a);
    }
    CHECK(dot(s.node_sets[set].angle, axis) == Approx(angle).epsilon(1e-12));
    // what turns as one body bears nothing
    CHECK(std::fabs(s.node_sets[set].work) < 1e-12);
    CHECK(norm(s.node_sets[set].moment) < 1e-9);
    CHECK(energies(s).elastic < 1e-15);
}

TEST_CASE("A set holds along its axes alone", "[solids]")
{
    const Packing p = packing(40, 5);
    const double height = p.solid.high.z;
    SolidState s = made(p, false);
    const int set = add_node_set(s, between(s, -a, 0.2 * height), { true, false, true });
    scale_masses(s, damping, dt);
    set_motion_of(s, set, { 1e-9 * height, 0.0, 0.0 }, {});
    drive_node_sets(s, dt);
    promise_work(s, dt);
    go(s, 10);
    CHECK(s.node_sets[set].displacement.x == Approx(1e-8 * height).epsilon(1e-12));
    CHECK(s.node_sets[set].force.y == 0.0);
    CHECK_THROWS_WITH(set_motion_of(s, set, { 0.0, 1.0, 0.0 }, {}),
        Catch::Contains("along y = 1 m/s, must be 0"));
    CHECK_THROWS_WITH(set_motion_of(s, 3, {}, {}), Catch::Contains("node set = 3"));
    CHECK_THROWS_WITH(set_pivot(s, 3, {}), Catch::Contains("node set = 3"));
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH(set_motion_of(s, set, {}, { none, 0.0, 0.0 }), Catch::Contains("spin"));
    CHECK_THROWS_WITH(set_pivot(s, set, { 0.0, none, 0.0 }), Catch::Contains("pivot"));
    CHECK_THROWS_WITH(add_node_set(s, {}, all), Catch::Contains("nodes of a set = 0"));
    CHECK_THROWS_WITH(add_node_set(s, { s.node_sets[set].nodes.front() }, all),
        Catch::Contains("is fixed already"));
    CHECK_THROWS_WITH(add_node_set(s, { -5 }, all), Catch::Contains("node of a set = -5"));
    CHECK_THROWS_WITH(add_node_set(s, between(s, 0.5 * height, height), { false, false, false }),
        Catch::Contains("axes of a set = 0"));
    // plates and sets do not share nodes
    const SolidPatch lid { -1.0 * up, { -a, -a, height - a },
        { p.solid.high.x + a, p.solid.high.y + a, height + a } };
    const SolidPatch base { up, { -a, -a, -a }, { p.solid.high.x + a, p.solid.high.y + a, a } };
    CHECK_THROWS_WITH(add_patch_plate(s, base), Catch::Contains("lies on a plate"));
    add_patch_plate(s, lid);
    CHECK_THROWS_WITH(
        add_node_set(s, between(s, 0.8 * height, height + a), all), Catch::Contains("on a plate"));
}
