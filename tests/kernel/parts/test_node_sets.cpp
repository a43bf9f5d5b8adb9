// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Node sets: held, moved and turned nodes, their forces, moments and works, and those that
/// float. SI units.
#include "support/catch.hpp"

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/laboratory/axial_measures.hpp>
#include <flexpm/kernel/laboratory/loading_motion.hpp>
#include <flexpm/kernel/laboratory/part_measures.hpp>
#include <flexpm/kernel/parts/node_sets.hpp>
#include <flexpm/kernel/parts/part_plates.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/plane_lanes/rigid_grain.hpp>
#include <flexpm/kernel/statics/static_solve.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/step/step.hpp>
#include <flexpm/kernel/topology/plate_build.hpp>
#include <flexpm/kernel/topology/removal.hpp>

#include "support/balance.hpp"
#include "support/driven.hpp"
#include "support/specimens.hpp"

#include <cmath>

using namespace flexpm;
using Catch::Contains;

namespace {

constexpr double size = 3e-3;  // side of the square grains [m]
constexpr int columns = 12, rows = 3;
constexpr double length = columns * size, height = rows * size;

/// A beam of square grains.
Assembly beam(bool rigid)
{
    auto o = specimens::options(specimens::strong_contact());
    o.rigid = rigid;
    Assembly a = specimens::assemble(specimens::grid(columns, rows, size), o);
    scale_masses(a, 0.7);
    return a;
}

/// Nodes between two places along x.
std::vector<int> nodes_between(const Assembly& a, double from, double to)
{
    std::vector<int> found;
    for (int n : holdable_nodes(a)) {
        const double x = a.grains.reference[component(n, 0)];
        if (x >= from && x <= to) found.push_back(n);
    }
    return found;
}

struct Ends {
    int left, right;
};

Ends hold_ends(Assembly& a, bool x = true, bool y = true)
{
    const int left = add_node_set(a, nodes_between(a, 0.0, size), { true, true, false });
    return { left, add_node_set(a, nodes_between(a, length - size, length), { x, y, false }) };
}

/// A loading at a constant velocity, started without a wave.
void start(Assembly& a, int set, Point velocity, double spin)
{
    set_motion_of(a, set, velocity, { 0.0, 0.0, spin });
    drive_node_sets(a, 1.0);
    start_elastically(a, true, Held::by_parts);
    drive_node_sets(a, 1.0);
}

PartGeometry of_sets(const std::vector<int>& driven, Point direction, double turn = 0.0)
{
    PartGeometry parts;
    parts.driven_sets = driven;
    parts.direction = direction;
    parts.turn = { 0.0, 0.0, turn };
    parts.area = parts.length = 1.0;
    return parts;
}

double miss_of(const Assembly& a)
{
    const Energies e = energies(a);
    return std::fabs(balance::miss(e)) / e.boundary_work;
}

double works(const Assembly& a)
{
    double sum = 0.0;
    for (const NodeSet& set : a.node_sets)
        sum += set.work;
    return sum;
}

}  // namespace

TEST_CASE("Sets hold any node of deformable grains, and the centres of rigid ones")
{
    const Assembly soft = beam(false), hard = beam(true);
    CHECK(holdable_nodes(soft).size() == static_cast<std::size_t>(count_grains(soft.grains).nodes));
    CHECK(holdable_nodes(hard).size() == static_cast<std::size_t>(columns * rows));
    for (int n : holdable_nodes(hard))
        CHECK(n == hard.grains.centre(grain_node(hard.grains, n).grain));
}

TEST_CASE("A beam that sets pull has equal forces at both ends, and their work is its energy")
{
    Assembly a = beam(GENERATE(false, true));
    const auto [left, right] = hold_ends(a);
    start(a, right, { 1e-9, 0.0 }, 0.0);
    reset_energy_balance(a);
    const double motion = energies(a).boundary_work;
    CHECK(motion == Approx(kinetic_of_velocities(a.grains)));
    driven::run_measured(a, 1000);
    const NodeSet &held = a.node_sets[left], &driven = a.node_sets[right];
    CHECK(driven.force.x > 0.0);
    CHECK(held.force.x == Approx(-driven.force.x).epsilon(1e-3));
    CHECK(driven.displacement.x == Approx(1e-6));
    CHECK(driven.work == Approx(0.5 * driven.force.x * driven.displacement.x).epsilon(0.01));
    // the elastic start is work of the boundary that no part does
    CHECK(works(a) + motion == Approx(energies(a).boundary_work).epsilon(1e-9));
    CHECK(energies(a).initial == 0.0);
    CHECK(miss_of(a) < 1e-9);
    const PartGeometry parts = of_sets({ right }, { 1.0, 0.0 });
    CHECK(part_load(a, parts) == driven.force.x);
    CHECK(part_displacement(a, parts) == driven.displacement.x);
    PartGeometry both = parts;
    both.holding_sets = { left };
    CHECK(observe(a, part_frame(a, both)).end_mismatch < 1e-3);
    CHECK(part_scales(a, both, 1.0, 1.0).modulus
        == Approx(driven.force.x / driven.displacement.x).epsilon(1e-3));
    const Array<double> none(a.grains.displacement.size(), 0.0);
    CHECK(part_load_rate(a, parts, none) == Approx(driven.force.x / 1000.0).epsilon(1e-2));
}

TEST_CASE("What is held along one axis is free along the other")
{
    Assembly a = beam(GENERATE(false, true));
    const auto [left, right] = hold_ends(a, true, false);
    start(a, right, { 1e-9, 0.0 }, 0.0);
    driven::run_measured(a, 1000);
    CHECK(a.node_sets[left].force.x < 0.0);
    CHECK(a.node_sets[right].force.y == 0.0);
    double widest = 0.0;
    for (int n : a.node_sets[right].nodes)
        widest = std::max(widest, std::fabs(a.grains.displacement[component(n, 1)]));
    CHECK(widest > 0.0);
}

TEST_CASE("Nodes that turn about a point go round it, however far")
{
    Assembly a = beam(GENERATE(false, true));
    const int all = add_node_set(a, holdable_nodes(a), { true, true, false });
    const Point pivot = { 0.01, -0.02 };
    set_pivot(a, all, pivot);
    set_motion_of(a, all, {}, { 0.0, 0.0, 1e-3 });
    drive_node_sets(a, 1.0);
    for (int g = 0; g < a.grains.count; ++g) {
        if (a.grains.is_rigid(g)) driven::prescribe_spin(a.grains, g, 1e-3);
    }
    driven::run_measured(a, 1571);  // a quarter of a turn
    const double angle = 1.571;
    CHECK(a.node_sets[all].angle.z == Approx(angle));
    for (int n : a.node_sets[all].nodes) {
        const Point arm = vector_at(a.grains.reference, n) - pivot;
        const Point now = a.grains.point_at(n) - pivot;
        CHECK(now.x == Approx(std::cos(angle) * arm.x - std::sin(angle) * arm.y).margin(1e-12));
        CHECK(now.y == Approx(std::sin(angle) * arm.x + std::cos(angle) * arm.y).margin(1e-12));
    }
    CHECK(energies(a).elastic < 1e-12);
}

TEST_CASE("A set that floats bears a moment alone, which is the same all along a beam")
{
    Assembly a = beam(GENERATE(false, true));
    const auto [left, right] = hold_ends(a);
    let_float(a, right);
    const PartGeometry parts = of_sets({ right }, {}, 1.0);
    const double stiffness = part_scales(a, parts, 1.0, 1.0).modulus;
    start(a, right, {}, 1e-9);
    reset_energy_balance(a);
    const double motion = energies(a).boundary_work;
    driven::run_measured(a, 4000);
    const NodeSet &held = a.node_sets[left], &turned = a.node_sets[right];
    CHECK(turned.angle.z == Approx(4e-6));
    CHECK(part_displacement(a, parts) == turned.angle.z);
    CHECK(part_load(a, parts) == turned.moment.z);
    CHECK(turned.moment.z == Approx(stiffness * turned.angle.z).epsilon(1e-3));
    CHECK(held.moment.z == Approx(-turned.moment.z).epsilon(5e-3));
    CHECK(norm(turned.force) * length < 5e-3 * turned.moment.z);
    // its end has moved by that of an arc, about half of the angle times the length between the
    // sets
    CHECK(turned.displacement.y
        == Approx(0.5 * turned.angle.z * (length - 2.0 * size)).epsilon(0.15));
    CHECK(miss_of(a) < 1e-9);
    CHECK(turned.work + motion == Approx(energies(a).boundary_work).epsilon(1e-9));
    CHECK(unbalanced_ratio(a) < 1e-2);
    CHECK(damping_power(a, 0.7) >= 0.0);
}

TEST_CASE("Two ends that turn against each other load by the sum of their moments")
{
    Assembly a = beam(false);
    const auto [left, right] = hold_ends(a);
    PartGeometry parts = of_sets({ right }, {}, 1.0);
    parts.back_sets = { left };
    set_motion_of(a, left, {}, { 0.0, 0.0, -1e-9 });
    start(a, right, {}, 1e-9);
    driven::run_measured(a, 1000);
    CHECK(part_load(a, parts) == a.node_sets[right].moment.z - a.node_sets[left].moment.z);
    CHECK(a.node_sets[left].angle.z == Approx(-1e-6));
    for (const NodeSet& set : a.node_sets) {
        for (const flexpm::Vector& v : { set.velocity, set.pivot, set.displacement, set.force })
            CHECK(v.z == 0.0);
        for (const flexpm::Vector& v : { set.spin, set.angle, set.moment })
            CHECK((v.x == 0.0 && v.y == 0.0 && v.z != 0.0));
    }
    CHECK(part_scales(a, parts, 1.0, 1.0).modulus
        == Approx(part_load(a, parts) / part_displacement(a, parts)).epsilon(1e-3));
    CHECK_THROWS_WITH(observe(a, part_frame(a, of_sets({ 7 }, {}, 1.0))),
        Contains("must be the index of a node set"));
    CHECK_THROWS_WITH(observe(a, part_frame(a, of_sets({ 0 }, {}))), Contains("direction"));
}

TEST_CASE("A loading that changes its velocity takes one that floats along, and the balance closes")
{
    Assembly a = beam(GENERATE(false, true));
    const int right = hold_ends(a).right;
    let_float(a, right);
    start(a, right, {}, 1e-9);
    reset_energy_balance(a);
    driven::run_measured(a, 200);
    const double before = a.node_sets[right].velocity.y, moment = a.loading.sets[right].moment.z;
    set_motion_of(a, right, {}, { 0.0, 0.0, 2e-9 });
    change_loading(a, 2.0);
    drive_node_sets(a, 1.0);
    CHECK(a.node_sets[right].velocity.y == Approx(2.0 * before).epsilon(0.05));
    CHECK(a.loading.sets[right].moment.z == Approx(2.0 * moment));
    driven::run_measured(a, 200);
    CHECK(renew_loading(a));
    CHECK(a.loading.sets[right].moment.z == Approx(2.0 * moment));
    CHECK(renew_loading(a, -1.0));
    CHECK(a.loading.sets[right].moment.z == Approx(2.0 * moment));
    driven::run_measured(a, 200);
    CHECK(miss_of(a) < 1e-9);
}

TEST_CASE("A velocity that is set between steps goes with the works")
{
    Assembly a = beam(GENERATE(false, true));
    const int right = hold_ends(a).right;
    reset_energy_balance(a);
    for (double velocity : { 1e-10, 3e-10, -1e-10 }) {
        set_motion_of(a, right, { velocity, 0.5 * velocity }, { 0.0, 0.0, 10.0 * velocity });
        drive_node_sets(a, 1.0);
        driven::run_measured(a, 100);
    }
    CHECK(miss_of(a) < 1e-9);
    CHECK(works(a) == Approx(energies(a).boundary_work).epsilon(1e-9));
}

TEST_CASE("An erased grain leaves its set, which may become empty")
{
    Assembly a = beam(GENERATE(false, true));
    const int grain = 5, set = add_node_set(a, { a.grains.centre(grain) }, { true, true, false });
    remove_grain(a, grain);
    CHECK(a.node_sets[set].nodes.empty());
    let_float(a, set);
    update_node_sets(a, 1.0, 0.7);
    CHECK(a.node_sets[set].velocity.x == 0.0);
    const int one =
        add_node_set(a, { a.grains.centre(0), a.grains.centre(1) }, { true, true, false });
    remove_grain(a, 0);
    CHECK(a.node_sets[one].grains == std::vector<int> { 1 });
    for (int n : holdable_nodes(a))
        CHECK(grain_node(a.grains, n).grain != grain);
}

TEST_CASE("Sets that hold nothing, what is held, or what a plate presses are refused")
{
    Assembly a = beam(GENERATE(false, true));
    const std::vector<int> left = nodes_between(a, 0.0, size);
    CHECK_THROWS_WITH(add_node_set(a, {}, { true, true, false }), Contains("nodes of a set"));
    CHECK_THROWS_WITH(
        add_node_set(a, { -7 }, { true, true, false }), Contains("that a set may hold"));
    const int set = add_node_set(a, left, { true, false, false });
    CHECK_THROWS_WITH(add_node_set(a, left, { true, true, false }), Contains("is fixed already"));
    CHECK(a.node_sets.size() == 1);
    add_node_set(a, left, { false, true, false });
    CHECK_THROWS_WITH(
        add_patch_plate(a, { { 0.0, height / 2 }, height, {} }, {}), Contains("lies on a plate"));
    CHECK_THROWS_WITH(add_side_plates(a, 3, 1, {}), Contains("lies on a plate"));
    add_side_plates(a, 1, 1, {});
    const std::vector<int> right = nodes_between(a, length - size, length);
    CHECK_THROWS_WITH(add_node_set(a, right, { true, true, false }), Contains("lies on a plate"));
    CHECK_THROWS_WITH(set_motion_of(a, 9, {}, { 0.0, 0.0, 0.0 }), Contains("node set"));
    CHECK_THROWS_WITH(set_motion_of(a, -1, {}, { 0.0, 0.0, 0.0 }), Contains("node set"));
    CHECK_THROWS_WITH(set_motion_of(a, set, { NAN, 0.0 }, { 0.0, 0.0, 0.0 }), Contains("velocity"));
    CHECK_THROWS_WITH(set_motion_of(a, set, {}, { 0.0, 0.0, NAN }), Contains("spin"));
    const int slides =
        add_node_set(a, nodes_between(a, 2.0 * size, 3.0 * size), { true, false, false });
    CHECK_THROWS_WITH(
        set_motion_of(a, slides, { 1e-9, 1e-9 }, { 0.0, 0.0, 0.0 }), Contains("it is free there"));
    CHECK(a.node_sets[slides].velocity.x == 0.0);
    let_float(a, set);
    CHECK_THROWS_WITH(
        set_motion_of(a, set, { 1e-9, 0.0 }, { 0.0, 0.0, 0.0 }), Contains("turns freely"));
    CHECK_THROWS_WITH(set_pivot(a, set, { NAN, 0.0 }), Contains("pivot"));
    CHECK_THROWS_WITH(let_float(a, 9), Contains("node set"));
}

TEST_CASE("A node of a set that floats cannot have a given displacement")
{
    Assembly a = beam(GENERATE(false, true));
    const int right = hold_ends(a).right;
    let_float(a, right);
    const int second = component(a.node_sets[right].nodes[1], 0);
    CHECK_THROWS_WITH(solve_static(a, { { second, 0.0 } }), Contains("floats"));
}
