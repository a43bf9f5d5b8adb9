// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Grains in space that meet anew, and faces that slide away from each other.
#include "support/catch.hpp"

#include <flexpm/kernel/assembly/solid_plan.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/pairs/pair_search.hpp>

#include "support/balance.hpp"
#include "support/same_bits.hpp"
#include "support/solid_states.hpp"

using namespace solid_states;

namespace {

constexpr double side = solid_samples::side;

/// Cubes in a row along x, and one upon each of some of them.
SolidState cubes(int nx, int nz, bool rigid)
{
    return make_solid(solid_samples::brick(nx, 1, nz), Solid::box(nx * side, side, nz * side),
        granite(FacePointRule::corners_and_inner, rigid));
}

/// Let a grain move with a velocity that is given.
void drive(SolidState& s, int grain, Vector velocity)
{
    const bool rigid = s.grains.is_rigid(grain);
    for (int n = 0; n < s.grains.nodes_of(grain); ++n) {
        const int node = s.grains.node(grain, n);
        if (rigid && node != s.grains.centre(grain)) continue;
        set_space_vector(s.grains.velocity, node, velocity);
        for (int axis = 0; axis < 3; ++axis)
            s.grains.prescribed[s.grains.component(node, axis)] = 1;
    }
    if (rigid) set_spin(s, grain, {}, true);
}

void drive_all(SolidState& s, const std::vector<int>& grains, Vector velocity)
{
    for (int g = 0; g < s.grains.count; ++g)
        drive(s, g, std::count(grains.begin(), grains.end(), g) ? velocity : Vector {});
}

/// Move grains by a way in so many steps, looking for pairs before each of them.
void move_by(SolidState& s, const std::vector<int>& grains, Vector way, int steps)
{
    drive_all(s, grains, (1.0 / steps) * way);
    for (int k = 0; k < steps; ++k) {
        look_for_pairs(s);
        step(s, { 1.0, 0.0, 1, true });
    }
    drive_all(s, grains, {});
}

/// Force on some grains by all contacts and pairs [N].
Vector force_on(const SolidState& s, const std::vector<int>& grains)
{
    const auto has = [&](int g) { return std::count(grains.begin(), grains.end(), g) > 0; };
    Vector sum;
    const auto add = [&](const GrainPair& pair, Vector on_second) {
        if (has(pair[1]) && !has(pair[0])) sum = sum + on_second;
        if (has(pair[0]) && !has(pair[1])) sum = sum - on_second;
    };
    for (int c = 0; c < s.contacts.count; ++c)
        add(s.contacts.pairs[c], contact_force(s, c));
    for (const PairContact& pair : s.pairs)
        add(pair.grains, pair.force);
    return sum;
}

/// What nodes or bodies feel of all forces together.
Resultant resultant(SolidState& s)
{
    show_nodes(s);
    Resultant sum;
    for (int g = 0; g < s.grains.count; ++g) {
        if (s.grains.is_rigid(g)) {
            const int centre = s.grains.centre(g);
            const Vector force = space_vector(s.grains.force, centre);
            sum.force = sum.force + force;
            sum.moment = sum.moment + s.bodies[g].moment + cross(s.grains.position(centre), force);
            continue;
        }
        for (int n = 0; n < s.grains.nodes_of(g); ++n) {
            const int node = s.grains.node(g, n);
            const Vector force = space_vector(s.grains.force, node);
            sum.force = sum.force + force;
            sum.moment = sum.moment + cross(s.grains.position(node), force);
        }
    }
    return sum;
}

/// Grains that fly against each other's motion, so that faces part and others meet. Their friction
/// falls after cracks.
SolidState flying(bool rigid)
{
    const Packing p = packing(tile_grains + 20, 6);
    SolidInput input = granite(FacePointRule::corners_and_inner, rigid);
    input.contacts[0].residual_friction = 0.25 * input.contacts[0].friction;
    input.contacts[0].slip_length = 0.1 * side;
    SolidState s = make_solid(p.cells, p.solid, input);
    Random random(9);
    for (int g = 0; g < s.grains.count; ++g) {
        const Vector v = 100.0 * solid_samples::draw(random);
        for (int n = 0; n < s.grains.nodes_of(g); ++n)
            set_space_vector(s.grains.velocity, s.grains.node(g, n), v);
    }
    return s;
}

}  // namespace

TEST_CASE("Intact grains have no pairs", "[pairs]")
{
    for (const bool rigid : { false, true }) {
        const Packing p = packing(40, 6);
        SolidState s =
            make_solid(p.cells, p.solid, granite(FacePointRule::corners_and_inner, rigid));
        CHECK_FALSE(look_for_pairs(s));
        CHECK(s.pairs.empty());
        CHECK(s.contacts.ended.empty());
    }
}

TEST_CASE(
    "A grain that has parted from another presses it anew with K_n, wherever it lands", "[pairs]")
{
    const auto contact = specimens::granite_contact();
    for (const bool rigid : { false, true }) {
        SolidState s = cubes(1, 2, rigid);
        scale_masses(s, 0.0);
        move_by(s, { 1 }, { 0.0, 0.0, 0.1 * side }, 50);
        REQUIRE(s.contacts.has_ended(0));
        CHECK(norm(force_on(s, { 1 })) == 0.0);
        const double stays = 0.75, depth = 1e-3 * side;
        move_by(s, { 1 }, { (1.0 - stays) * side, 0.0, 0.0 }, 20);
        move_by(s, { 1 }, { 0.0, 0.0, -0.1 * side - depth }, 200);
        REQUIRE(s.pairs.size() == 1);
        CHECK(s.pairs[0].clearance == 0.0);
        // the overlap is a plate of 0.75 x 1 x delta, which is nearest to its rim within delta / 2
        const double flush = contact.normal_stiffness * stays * side * side * depth;
        const Vector force = force_on(s, { 1 });
        CHECK(force.z < flush);
        CHECK(force.z > (1.0 - 3.0 * depth / side) * flush);
        CHECK(std::fabs(force.x) < 2.0 * depth / side * flush);
        CHECK(s.pairs[0].area == Approx(stays * side * side).epsilon(4.0 * depth / side));
        // and lifts off again
        move_by(s, { 1 }, { 0.0, 0.0, 2.0 * depth }, 50);
        CHECK(norm(force_on(s, { 1 })) == 0.0);
        CHECK(s.pairs[0].elastic_energy == 0.0);
    }
}

TEST_CASE("A cracked face that slides away hands over to a pair without a jump", "[pairs]")
{
    const auto contact = specimens::granite_contact();
    for (const bool rigid : { false, true }) {
        SolidState s = cubes(1, 2, rigid);
        scale_masses(s, 0.0);
        const double pressure = 100e6, depth = pressure / contact.normal_stiffness;
        move_by(s, { 1 }, { 0.0, 0.0, 1e-5 }, 20);  // cracks
        move_by(s, { 1 }, { 0.0, 0.0, -1e-5 - depth }, 200);
        const double before = force_on(s, { 1 }).z;
        CHECK(before == Approx(pressure * side * side).epsilon(1e-6));
        CHECK(s.pairs.empty());
        double last = before, energy = 0.0, jump = 0.0;
        for (int k = 0; k < 100; ++k) {
            for (int i = 0; i < 100; ++i) {
                move_by(s, { 1 }, { 5e-5 * side, 0.0, 0.0 }, 1);
                const double force = force_on(s, { 1 }).z;
                jump = std::max(jump, std::fabs(force - last));
                last = force;
            }
            const Vector force = force_on(s, { 1 });
            CHECK(-force.x / force.z == Approx(contact.friction).epsilon(1e-3));
            const double now = energies(s).elastic;
            if (k > 0) CHECK(now < energy * (1.0 + 1e-9));
            energy = now;
        }
        CHECK(jump < 0.011 * before);
        CHECK(s.contacts.has_ended(0));
        // half of the face is left
        CHECK(last == Approx(0.5 * before).epsilon(0.03));
        CHECK(std::fabs(balance::miss(energies(s))) < 1e-3 * energies(s).friction);
    }
}

TEST_CASE("The friction of a face falls with its slip, which goes over to its pair", "[pairs]")
{
    auto contact = specimens::granite_contact();
    contact.residual_friction = 0.4 * contact.friction;
    contact.slip_length = 0.04 * side;  // a face hands over after half of it
    const double fall = (contact.friction - contact.residual_friction) / contact.slip_length;
    for (const bool rigid : { false, true }) {
        SolidInput input = granite(FacePointRule::corners_and_inner, rigid);
        input.contacts = { contact };
        SolidState s =
            make_solid(solid_samples::brick(1, 1, 2), Solid::box(side, side, 2.0 * side), input);
        scale_masses(s, 0.0);
        const double pressure = 100e6, depth = pressure / contact.normal_stiffness;
        move_by(s, { 1 }, { 0.0, 0.0, 1e-5 }, 20);  // cracks
        move_by(s, { 1 }, { 0.0, 0.0, -1e-5 - depth }, 200);
        // of the way it slides, friction holds an elastic part, mu times this
        const double elastic = pressure / (contact.shear_ratio * contact.normal_stiffness);
        const auto friction_at = [&](double way) {
            const double mu = (contact.friction - fall * way) / (1.0 - fall * elastic);
            return std::max(mu, contact.residual_friction);
        };
        const double part = 2e-5 * side;
        double last = contact.friction, jump = 0.0;
        int of_face = 0, of_pair = 0, residual = 0;
        const auto slide = [&](double sense, int from, int to, double lost) {
            for (int k = from + 1; k <= to; ++k) {
                move_by(s, { 1 }, { sense * part, 0.0, 0.0 }, 1);
                if ((k - from) * part < 2.0 * contact.friction * elastic) continue;  // may stick
                const Vector force = force_on(s, { 1 });
                const double mu = -sense * force.x / force.z;
                REQUIRE(mu == Approx(friction_at(k * part - lost)).epsilon(1e-3));
                jump = std::max(jump, std::fabs(mu - last));
                last = mu;
                (s.contacts.has_ended(0) ? of_pair : of_face) += 1;
                residual += mu < 1.001 * contact.residual_friction;
            }
        };
        slide(1.0, 0, 250, 0.0);
        const double turned = last;
        // plastic slips of either sense add up
        slide(-1.0, 250, 500, 2.0 * turned * elastic);
        const double back = last;
        slide(1.0, 500, 3500, 2.0 * (turned + back) * elastic);
        CAPTURE(rigid, of_face, of_pair, residual, jump);
        CHECK(of_face > 500);
        CHECK(of_pair > 500);
        CHECK(residual > 500);
        CHECK(jump < 2.0 * fall * 2.0 * contact.friction * elastic);
        // each begin and end of a motion books its work half a step late
        CHECK(std::fabs(balance::miss(energies(s))) < 1.5e-3 * energies(s).friction);
    }
}

TEST_CASE("Grains that meet anew have the residual friction at once", "[pairs]")
{
    auto contact = specimens::granite_contact();
    contact.residual_friction = 0.4 * contact.friction;
    contact.slip_length = side;
    for (const bool rigid : { false, true }) {
        SolidInput input = granite(FacePointRule::corners_and_inner, rigid);
        input.contacts = { contact };
        SolidState s = make_solid(
            solid_samples::brick(2, 1, 2), Solid::box(2.0 * side, side, 2.0 * side), input);
        scale_masses(s, 0.0);
        // grain 3 goes up, above grain 0, and down
        move_by(s, { 3 }, { 0.5 * side, 0.0, 0.0 }, 50);
        move_by(s, { 3 }, { 0.0, 0.0, side }, 50);
        move_by(s, { 2 }, { 0.0, side, 0.0 }, 50);
        move_by(s, { 3 }, { -1.5 * side, 0.0, 0.0 }, 100);
        const double depth = 1e-3 * side;
        move_by(s, { 3 }, { 0.0, 0.0, -side - depth }, 400);
        move_by(s, { 3 }, { 0.01 * side, 0.0, 0.0 }, 100);
        const Vector force = force_on(s, { 3 });
        CHECK(force.z > 0.0);
        CHECK(-force.x / force.z == Approx(contact.residual_friction).epsilon(5e-3));
    }
}

TEST_CASE("A block slides over a row of grains without a catch at their seams", "[pairs]")
{
    const auto contact = specimens::granite_contact();
    for (const bool rigid : { false, true }) {
        SolidState s = cubes(5, 2, rigid);
        scale_masses(s, 0.0);
        // grains come row by row: the upper one at the left is number 5; take the others away
        const std::vector<int> block { 5 };
        std::vector<int> others { 6, 7, 8, 9 };
        move_by(s, others, { 0.0, 0.0, 5.0 * side }, 100);
        move_by(s, block, { 0.0, 0.0, 1e-5 }, 20);
        const double depth = 1e-3 * side;
        move_by(s, block, { 0.3 * side, 0.0, -1e-5 - depth }, 200);
        const double full = contact.normal_stiffness * side * side * depth;
        for (int k = 0; k < 60; ++k) {
            move_by(s, block, { 0.05 * side, 0.0, 0.0 }, 20);
            const Vector force = force_on(s, block);
            CHECK(force.z == Approx(full).epsilon(4.0 * depth / side));
            CHECK(-force.x / force.z == Approx(contact.friction).epsilon(5e-3));
            CHECK(std::fabs(force.y) < 1e-3 * full);
        }
    }
}

TEST_CASE("Grains that meet keep both momenta and the energy", "[pairs]")
{
    for (const bool rigid : { false, true }) {
        SolidState s = cubes(1, 2, rigid);
        scale_masses(s, 0.0, 0.1);  // ten times smaller steps than needed
        move_by(s, { 1 }, { 0.0, 0.0, 0.05 * side }, 50);
        REQUIRE(s.contacts.has_ended(0));
        std::fill(s.grains.prescribed.begin(), s.grains.prescribed.end(), 0);
        const Vector toward { 1e-7, 2e-7, -2e-6 };
        for (int g = 0; g < 2; ++g) {
            const Vector spin =
                g == 0 ? Vector { 1e-4, 2e-4, -1e-4 } : Vector { -2e-4, 1e-4, 3e-4 };
            const int centre = s.grains.centre(g);
            for (int n = 0; n < s.grains.nodes_of(g); ++n) {
                const int node = s.grains.node(g, n);
                set_space_vector(s.grains.velocity, node,
                    (g == 0 ? -0.5 : 0.5) * toward
                        + cross(spin, s.grains.position(node) - s.grains.position(centre)));
            }
            if (rigid) set_spin(s, g, spin, false);
        }
        const double before = kinetic_of_velocities(s);
        const Energies start = energies(s);
        int pressed = 0;
        double worst_force = 0.0, worst_moment = 0.0, largest = 0.0;
        for (int k = 0; k < 4000; ++k) {
            if (k % 10 == 0) look_for_pairs(s);
            step(s, { 0.1, 0.0, 1, true });
            const bool presses = !s.pairs.empty() && s.pairs[0].presses();
            pressed += presses;
            const Resultant on = resultant(s);
            if (presses) largest = std::max(largest, norm(s.pairs[0].force));
            worst_force = std::max(worst_force, norm(on.force));
            worst_moment = std::max(worst_moment, norm(on.moment));
        }
        CAPTURE(rigid, pressed, before);
        CHECK(pressed > 50);
        CHECK((s.pairs.empty() || !s.pairs[0].presses()));
        CHECK(worst_force < 1e-12 * largest);
        CHECK(worst_moment < 1e-11 * largest * side);
        const Energies now = energies(s);
        const double rubbed = now.friction - start.friction;
        CHECK(rubbed > 0.0);
        CHECK(now.kinetic + now.elastic + rubbed == Approx(before).epsilon(2e-3));
    }
}

TEST_CASE("A search creates no energy", "[pairs]")
{
    for (const bool rigid : { false, true }) {
        SolidState s = flying(rigid);
        int ended = 0;
        for (int k = 0; k < 300; ++k) {
            const Energies before = energies(s);
            if (k % 10 == 0) look_for_pairs(s);
            const Energies after = energies(s);
            CAPTURE(rigid, k);
            CHECK(after.friction >= before.friction - 1e-12 * before.kinetic);
            step(s, { 2e-8, 0.3, 1, true });
        }
        for (int c = 0; c < s.contacts.count; ++c)
            ended += s.contacts.has_ended(c);
        CHECK(ended > 100);
    }
}

TEST_CASE(
    "Pairs have the same bits on any number of threads, and when a saved state goes on", "[pairs]")
{
    const auto run = [](SolidState s, int threads, int from, int to) {
        for (int k = from; k < to; ++k) {
            if (k % 20 == 0) look_for_pairs(s);
            step(s, { 2e-8, 0.3, threads, true });
        }
        show_nodes(s);
        return s;
    };
    for (const bool rigid : { false, true }) {
        const SolidState s = flying(rigid);
        const SolidState whole = run(s, 1, 0, 200);
        const auto presses = [](const PairContact& pair) { return pair.presses(); };
        CHECK(std::count_if(whole.pairs.begin(), whole.pairs.end(), presses) > 20);
        const auto slid = [](const PairContact& pair) { return pair.crack_slip > 0.0; };
        CHECK(std::count_if(whole.pairs.begin(), whole.pairs.end(), slid) > 20);
        CHECK(same_bits::difference(whole, run(s, 2, 0, 200)) == "");
        CHECK(same_bits::difference(whole, run(s, 4, 0, 200)) == "");
        const SolidState until = run(s, 1, 0, 90);
        SolidState saved = same_bits::copy_of_members(until);
        prepare_step(saved);
        show_nodes(saved);
        CHECK(saved.plan.shown_forces == until.plan.shown_forces);
        CHECK(same_bits::difference(whole, run(saved, 1, 90, 200)) == "");
    }
}

TEST_CASE("A fast grain is found before it overlaps another", "[pairs]")
{
    for (const bool rigid : { false, true }) {
        SolidState s = cubes(1, 2, rigid);
        CHECK_FALSE(has_to_search(s, 1.0));
        move_by(s, { 1 }, { 0.0, 0.0, 0.5 * side }, 50);
        REQUIRE(s.contacts.has_ended(0));
        drive_all(s, { 1 }, { 0.0, 0.0, -0.01 * side });
        int searches = 0;
        for (int k = 0; k < 51; ++k) {
            const bool due = has_to_search(s, 1.0);
            searches += due;
            if (due) look_for_pairs(s);
            step(s, { 1.0, 0.0, 1, true });
        }
        CAPTURE(rigid, searches);
        CHECK(searches < 30);
        REQUIRE(s.pairs.size() == 1);
        CHECK(s.pairs[0].clearance == 0.0);
        CHECK(s.pairs[0].presses());
    }
}

TEST_CASE("A joint without strength hands over as it slides", "[pairs]")
{
    for (const bool rigid : { false, true }) {
        SolidInput input = granite(FacePointRule::corners_and_inner, rigid);
        ContactMaterial open = specimens::granite_contact();
        open.tensile_strength = open.cohesion = 0.0;
        open.tensile_fracture_energy = open.shear_fracture_energy = 0.0;
        open.friction = 0.6;
        input.joints = { open };
        input.joint = { 0 };
        SolidState s =
            make_solid(solid_samples::brick(1, 1, 2), Solid::box(side, side, 2.0 * side), input);
        scale_masses(s, 0.0);
        const double depth = 1e-4 * side;
        move_by(s, { 1 }, { 0.0, 0.0, -depth }, 10);
        CHECK(s.pairs.empty());
        move_by(s, { 1 }, { 0.3 * side, 0.0, 0.0 }, 300);
        REQUIRE(s.pairs.size() == 1);
        CHECK(s.pairs[0].face == 0);
        const Vector force = force_on(s, { 1 });
        CHECK(force.z == Approx(0.7 * open.normal_stiffness * side * side * depth).epsilon(0.01));
        CHECK(-force.x / force.z == Approx(open.friction).epsilon(1e-3));
    }
}

namespace {

/// Sum of mass times velocity [N s], and of the angular momenta of rigid grains [N m s].
std::array<Vector, 2> momenta(const SolidState& s)
{
    std::array<Vector, 2> sums {};
    for (int g = 0; g < s.grains.count; ++g) {
        const int last = s.grains.vertices_of(g), first = s.grains.is_rigid(g) ? last : 0;
        for (int n = first; n < s.grains.nodes_of(g); ++n) {
            const int node = s.grains.node(g, n);
            const double mass = 1.0 / s.grains.inverse_mass[s.grains.scalar_index(node)];
            sums[0] = sums[0] + mass * s.grains.vector(s.grains.velocity, node);
        }
    }
    for (const RigidBody& body : s.bodies)
        sums[1] = sums[1] + body.angular_momentum;
    return sums;
}

/// Masses of grains in motion are raised for pairs: momentum stays, and what is lost is damped.
void check_that_masses_keep_momentum(SolidState& s)
{
    for (int g = 0; g < s.grains.count; ++g) {
        for (int n = 0; n < s.grains.nodes_of(g); ++n)
            s.grains.set_vector(s.grains.velocity, s.grains.node(g, n), { 1.0 + g, 2.0, -0.5 * n });
        if (s.grains.is_rigid(g)) set_spin(s, g, { 3.0, -1.0, 2.0 + g }, false);
    }
    const std::array<Vector, 2> before = momenta(s);
    const double kinetic = kinetic_of_velocities(s), damped = energies(s).damping;
    REQUIRE(bear_pairs(s, 0.0, 1.0));
    const std::array<Vector, 2> after = momenta(s);
    for (int kind = 0; kind < 2; ++kind)
        CHECK(norm(after[kind] - before[kind]) <= 1e-13 * norm(before[kind]));
    const double lost = kinetic - kinetic_of_velocities(s);
    CHECK(lost > 1e-3 * kinetic);
    CHECK(energies(s).damping - damped == Approx(lost).epsilon(1e-9));
}

}  // namespace

TEST_CASE("Masses carry grains that land on each other's outer faces", "[pairs]")
{
    for (const bool rigid : { false, true }) {
        SolidState s = cubes(1, 2, rigid);
        scale_masses(s, 0.0);
        CHECK(stable_step(s, 0.0) == Approx(1.0));
        move_by(s, { 1 }, { 0.0, 0.0, 0.1 * side }, 50);
        // around to the other side, whose faces have never had a contact
        move_by(s, { 1 }, { 1.1 * side, 0.0, 0.0 }, 50);
        move_by(s, { 1 }, { 0.0, 0.0, -1.1 * side }, 50);
        move_by(s, { 1 }, { -0.101 * side, 0.0, 0.0 }, 50);
        REQUIRE(s.pairs.size() == 1);
        REQUIRE(s.pairs[0].presses());
        CHECK(bear_pairs(s, 0.0, 1.0));
        CHECK_FALSE(bear_pairs(s, 0.0, 1.0));
        CHECK(stable_step(s, 0.0) >= 1.0 - 1e-12);
        // real masses stay, and the step falls
        set_real_masses(s);
        const double before = stable_step(s, 0.0);
        CHECK(bear_pairs(s, 0.0, 0.0));
        CHECK(stable_step(s, 0.0) < before);
        // let go, at the limit of stability: energy swings, but does not grow
        scale_masses(s, 0.0);
        std::fill(s.grains.prescribed.begin(), s.grains.prescribed.end(), 0);
        for (RigidBody& body : s.bodies)
            body.spin_held = false;
        SolidState moving = s;
        bear_pairs(s, 0.0, 1.0);
        const double stored = energies(s).elastic;
        for (int k = 0; k < 500; ++k)
            step(s, { 1.0, 0.0, 1, true });
        CHECK(energies(s).kinetic + energies(s).elastic < 1.5 * stored);
        check_that_masses_keep_momentum(moving);
    }
}
