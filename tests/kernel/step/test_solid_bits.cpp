// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The same bits of specimens in space on any number of threads and every instruction set,
/// what a rotation and a motion as one leave, and what is refused.
#include "support/catch.hpp"

#include <flexpm/kernel/core/instruction_set.hpp>
#include <flexpm/kernel/measure/grain_stress.hpp>
#include <flexpm/kernel/step/solid_step.hpp>

#include "support/solid_states.hpp"

#include <cstring>

using namespace solid_states;

namespace {

/// Grains that fly apart and turn, so that faces open, slide and part.
SolidState flying(int grains = 40, bool rigid = false)
{
    const double speed = 20.0, spin = 10000.0;
    const Packing p = packing(grains, 6);
    SolidState s = make_solid(p.cells, p.solid, granite(FacePointRule::corners_and_inner, rigid));
    Random random(9);
    for (int g = 0; g < s.grains.count; ++g) {
        const Vector v = speed * solid_samples::draw(random);
        const Vector w = spin * solid_samples::draw(random);
        const Vector centre = space_vector(s.grains.reference, s.grains.centre(g));
        for (int n = 0; n < s.grains.nodes_of(g); ++n) {
            const int node = s.grains.node(g, n);
            const Vector arm = space_vector(s.grains.reference, node) - centre;
            set_space_vector(s.grains.velocity, node, v + cross(w, arm));
        }
        if (rigid) set_spin(s, g, w, false);
    }
    return s;
}

SolidState stepped(SolidState s, int threads, int count = 200)
{
    for (int k = 0; k < count; ++k)
        step(s, { 2e-8, 0.3, threads, true });
    return s;
}

bool same(const Array<double>& a, const Array<double>& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

bool same(const std::vector<Array<double>>& a, const std::vector<Array<double>>& b)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
        [](const Array<double>& x, const Array<double>& y) { return same(x, y); });
}

bool same(const SolidState& a, const SolidState& b)
{
    for (std::size_t g = 0; g < a.bodies.size(); ++g)
        if (std::memcmp(&a.bodies[g].spin, &b.bodies[g].spin, sizeof(Vector)) != 0) return false;
    return same(a.grains.displacement, b.grains.displacement)
        && same(a.grains.velocity, b.grains.velocity) && same(a.grains.force, b.grains.force)
        && same(a.contacts.states, b.contacts.states)
        && same(a.ledger.damping_work, b.ledger.damping_work)
        && same(a.ledger.kinetic, b.ledger.kinetic);
}

struct Momenta {
    Vector linear, angular;
    double scale = 0.0;  ///< sum of |m v|
};

/// Half a step after the places, which are taken there.
Momenta momenta(const SolidState& s, double dt)
{
    Momenta m;
    for_each_node(s, [&](int grain, int number) {
        const int node = s.grains.node(grain, number);
        const Vector v = space_vector(s.grains.velocity, node);
        const double inverse = s.grains.inverse_mass[s.grains.scalar_index(node)];
        if (inverse == 0.0) return;  // of a rigid grain, whose centre has all
        const Vector p = (1.0 / inverse) * v;
        const Vector place = space_vector(s.grains.reference, node)
            + space_vector(s.grains.displacement, node) + 0.5 * dt * v;
        m.linear = m.linear + p;
        m.angular = m.angular + cross(place, p);
        m.scale += norm(p);
    });
    for (const RigidBody& body : s.bodies)
        m.angular = m.angular + body.angular_momentum;
    return m;
}

}  // namespace

TEST_CASE(
    "A solid has the same bits on one, two, four and seven threads while it breaks", "[solids]")
{
    for (const bool rigid : { false, true }) {
        // several tiles, whose threads share grains; of seven some have none
        const SolidState start = flying(3 * tile_grains, rigid);
        REQUIRE(start.plan.tiles() == 3);
        const SolidState one = stepped(start, 1, 50);
        CHECK(count_cracks(one).tensile > 50);
        CHECK(energies(one).friction > 0.0);
        for (int threads : { 2, 4, 7 })
            CHECK(same(one, stepped(start, threads, 50)));
    }
}

TEST_CASE("A solid has the same bits on every instruction set", "[solids]")
{
    for (const bool rigid : { false, true }) {
        const SolidState start = flying(40, rigid);
        const InstructionSet before = instruction_set();
        use_instruction_set(InstructionSet::baseline);
        const SolidState expected = stepped(start, 1);
        for (const InstructionSet set : available_instruction_sets()) {
            use_instruction_set(set);
            CAPTURE(name_of(set), rigid);
            CHECK(same(expected, stepped(start, 1)));
        }
        use_instruction_set(before);
    }
}

TEST_CASE("The plan of a solid that was loaded continues to the same bits", "[solids]")
{
    for (const bool rigid : { false, true }) {
        const SolidState whole = stepped(flying(40, rigid), 1, 120);
        SolidState half = stepped(flying(40, rigid), 1, 60);
        half.plan = {};
        prepare_step(half);
        CHECK(same(whole, stepped(half, 1, 60)));
    }
}

TEST_CASE("Whether nodes of rigid grains are left behind changes no bit of a run", "[solids]")
{
    SolidState s = flying(40, true);
    const SolidState expected = stepped(s, 1);
    StepOptions o { 2e-8, 0.3, 1, true };
    o.leave_nodes = true;
    for (int k = 0; k < 200; ++k)
        step(s, o);
    CHECK(!same(expected.grains.displacement, s.grains.displacement));
    show_nodes(s);
    CHECK(same(expected, s));
}

TEST_CASE("Forces on the nodes of rigid grains come to the wrenches that move them", "[solids]")
{
    const SolidState s = stepped(flying(40, true), 1);
    double largest = 0.0, arm = 0.0, force = 0.0, moment = 0.0;
    for (int g = 0; g < s.grains.count; ++g) {
        const double* wrench = s.plan.wrenches.data() + s.grains.block_of(g) * WrenchRow::count;
        Resultant on;
        for_each_corner_force(s.grains, node_forces(s), g, [&](Vector f, Vector r) {
            on = { on.force + f, on.moment + cross(r, f) };
            largest = std::max(largest, norm(f));
            arm = std::max(arm, norm(r));
        });
        const auto row = [&](int i) { return Vector { wrench[i], wrench[i + 1], wrench[i + 2] }; };
        force = std::max(force, norm(on.force - row(WrenchRow::force)));
        moment = std::max(moment, norm(on.moment - row(WrenchRow::moment)));
    }
    CHECK(largest > 1.0);
    CHECK(force < 1e-10 * largest);
    CHECK(moment < 1e-10 * largest * arm);
}

TEST_CASE("A free solid keeps its momenta and energy while faces open, slide and part", "[solids]")
{
    for (const bool rigid : { false, true }) {
        SolidState s = flying(40, rigid);
        const double dt = 2e-8;
        const Momenta before = momenta(s, dt);
        double first = 0.0, worst = 0.0;
        for (int k = 0; k < 600; ++k) {
            step(s, { dt, 0.0, 1, true });
            const Energies e = energies(s);
            const double all = e.kinetic + e.elastic + e.damage + e.friction;
            if (k == 0) first = all;
            worst = std::max(worst, std::fabs(all - first));
        }
        const Momenta after = momenta(s, dt);
        CHECK(norm(after.linear - before.linear) < 1e-12 * before.scale);
        CHECK(norm(after.angular - before.angular) < 1e-12 * before.scale * solid_samples::side);
        CHECK(count_cracks(s).tensile > 20);
        CHECK(worst < 2e-3 * first);
    }
}

TEST_CASE("A solid turned by any angle has no force", "[solids]")
{
    const Packing p = packing(30, 4);
    SolidState s = make_solid(p.cells, p.solid, granite());
    for (const Vector angle : { Vector { 0.3, 0.0, 0.0 }, Vector { 1.0, -2.0, 2.0 } }) {
        const Quaternion turn = rotation_by(angle);
        for_each_node(s, [&](int grain, int number) {
            const int node = s.grains.node(grain, number);
            set_space_vector(s.grains.displacement, node,
                turned_by(turn, space_vector(s.grains.reference, node)));
        });
        step(s, { 1e-30, 0.0, 1, false });
        double largest = 0.0;
        for (double f : s.grains.force)
            largest = std::max(largest, std::fabs(f));
        CHECK(largest > 0.0);
        CHECK(largest < 2e-9);  // places of 5 mm have a last digit of 1e-18 m
    }
}

TEST_CASE("Masses by the bound keep a solid stable, and stable_step() finds their step", "[solids]")
{
    const Packing p = packing(30, 3);
    for (const bool rigid : { false, true }) {
        for (const double damping : { 0.0, 0.7 }) {
            SolidInput input = granite(FacePointRule::corners_and_inner, rigid);
            input.contacts = { specimens::strong_contact() };
            SolidState s = make_solid(p.cells, p.solid, input);
            const bool real = rigid && damping == 0.0;
            if (!real) scale_masses(s, damping);
            const double dt = stable_step(s, damping);
            if (!real) CHECK(dt == Approx(1.0).epsilon(1e-12));
            Random random(4);
            for_each_node(s, [&](int grain, int number) {
                set_space_vector(s.grains.velocity, s.grains.node(grain, number),
                    1e-12 / dt * solid_samples::draw(random));
            });
            double first = 0.0, last = 0.0;
            for (int k = 0; k < 600; ++k) {
                step(s, { dt, damping, 1, true });
                const Energies e = energies(s);
                last = e.kinetic + e.elastic;
                if (k == 0) first = last;
            }
            CHECK(last < 1.5 * first);
            if (damping > 0.0) CHECK(last < 0.1 * first);
        }
    }
}

TEST_CASE("The bound of the least moment of inertia is one", "[solids]")
{
    CHECK(least_moment({ 1.0, 2.0, 3.0, 0.0, 0.0, 0.0 }) == Approx(1.0));
    // eigenvalues 1, 3 and 5
    CHECK(least_moment({ 2.0, 2.0, 5.0, 0.0, 0.0, 1.0 }) == Approx(1.0));
    // 0.5, 0.5 and 2: the circles leave nothing
    const double least = least_moment({ 1.0, 1.0, 1.0, 0.5, 0.5, 0.5 });
    CHECK(least > 0.0);
    CHECK(least <= 0.5);
}

TEST_CASE("What no solid can be made of is refused in one line", "[solids]")
{
    const Packing p = packing(12, 2);
    SolidInput input = granite();
    input.kind = { 0, 1 };
    CHECK_THROWS_WITH(make_solid(p.cells, p.solid, input), Catch::Contains("kinds given = 2"));
    input.kind.assign(p.cells.cells(), 1);
    CHECK_THROWS_WITH(make_solid(p.cells, p.solid, input), Catch::Contains("must be below 1"));
    input.kind.clear();
    input.contacts.push_back(input.contacts.front());
    CHECK_THROWS_WITH(
        make_solid(p.cells, p.solid, input), Catch::Contains("one for each pair of kinds"));
    SolidState s = make_solid(p.cells, p.solid, granite());
    CHECK_THROWS_WITH(step(s, { -1.0, 0.0, 1, false }), Catch::Contains("time step"));
    CHECK_THROWS_WITH(begin_from(s, {}, 1.0, 0.0), Catch::Contains("vectors of the field = 0"));
    SolidState stiff =
        make_solid(p.cells, p.solid, granite(FacePointRule::corners_and_inner, true));
    CHECK_THROWS_WITH(
        begin_from(stiff, {}, 1.0, 0.0), Catch::Contains("must be those of 12 rigid grains"));
    s.plan = {};
    CHECK_THROWS_WITH(step(s, {}), Catch::Contains("call prepare_step()"));
    prepare_step(s);
    // all corners at one place
    for_each_node(s, [&](int grain, int number) {
        const int node = s.grains.node(grain, number);
        set_space_vector(s.grains.displacement, node, -space_vector(s.grains.reference, node));
    });
    CHECK_THROWS_WITH(
        step(s, { 1e-9, 0.0, 1, false }), Catch::Contains("contacts without a middle face"));
}
