// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Plates of space that turn on a seat: no moment there, where they are laid, the linear
/// start.
#include "support/catch.hpp"

#include <flexpm/kernel/core/random.hpp>
#include <flexpm/kernel/laboratory/solid_drive.hpp>
#include <flexpm/kernel/laboratory/solid_parts.hpp>
#include <flexpm/kernel/parts/plate_springs.hpp>
#include <flexpm/kernel/parts/solid_patches.hpp>
#include <flexpm/kernel/parts/solid_plates.hpp>

#include "support/solid_states.hpp"

#include <algorithm>

using namespace solid_states;

namespace {

constexpr double damping = 0.7, dt = 1.0, a = solid_samples::side;
constexpr Vector down { 0.0, 0.0, -1.0 };

/// A box on a platen, 0, below a seated one, 1, whose contacts are three times as stiff on one
/// side.
struct Seated {
    SolidState s;
    PartGeometry parts;

    Seated(bool rigid, bool bonded, double friction = 0.0) :
        s(make_solid(
            box(40, 3).cells, box(40, 3).solid, granite(FacePointRule::corners_and_inner, rigid)))
    {
        const Vector top = box(40, 3).solid.high, beyond { top.x + a, top.y + a, top.z + a };
        add_patch_plate(s, { -1.0 * down, { -a, -a, -a }, { beyond.x, beyond.y, a }, 0.5 });
        SolidPatch patch { down, { -a, -a, top.z - a }, beyond, friction, bonded };
        patch.seated = true;
        add_patch_plate(s, patch);
        Plate& p = s.plates[1];
        for (PlatePoint& point : p.points)
            if (point.arm.x + 0.5 * point.arm.y > 0.0) point.area *= 3.0;
        scale_masses(s, damping, dt);
        parts = { { 1 }, { 0 }, down, top.x * top.y, top.z };
    }

    const Plate& top() const { return s.plates[1]; }
    void go(int steps)
    {
        for (int k = 0; k < steps; ++k)
            step(s, { dt, damping, 1, true });
    }
    /// Drive the plate from a linear solution, and let all come to rest.
    void drive(double way, int steps)
    {
        const SolidDrive drive = drive_of(parts);
        start(s, drive, elastic_field(s, drive), 0.0, way / steps, true, dt);
        go(steps);
        go_on(s, drive, 0.0, dt);
        go(3000);
    }
    Vector moment() const
    {
        Vector sum;
        for (int i = 0; i < plate_points(top()); ++i) {
            const double gap = top().points[i].opening;
            if (!top().bonded && gap >= 0.0) continue;
            sum = sum - point_stiffness(top(), i) * gap * point_arm(top(), i);
        }
        return sum;
    }
};

}  // namespace

TEST_CASE("A seated plate of space bears no moment while it loads", "[solids]")
{
    for (const bool rigid : { false, true }) {
        for (const bool bonded : { false, true }) {
            Seated test(rigid, bonded);
            const double way = 1e-6 * test.parts.length;
            test.drive(way, 400);
            const Plate& p = test.top();
            const double force = dot(p.force, down);
            CHECK(force > 0.0);
            CHECK(norm(test.moment()) < 1e-9 * force * a);
            CHECK(norm(p.turn) > 1e-3 * way / a);
            CHECK(p.turn.z == 0.0);
            const Energies e = energies(test.s);
            CHECK(std::fabs(e.kinetic + e.elastic + e.damage + e.friction + e.damping + e.drag
                      - e.boundary_work - e.initial)
                < 1e-4 * e.elastic);
        }
    }
}

TEST_CASE("Linear solutions let a seat of space turn as the steps do", "[solids]")
{
    for (const bool rigid : { false, true }) {
        Seated test(rigid, true);
        const double way = 1e-6 * test.parts.length;
        const SolidDrive drive = drive_of(test.parts);
        const SolidField field = elastic_field(test.s, drive);
        const double machine = field.load;  // for a way of 1 m
        test.drive(way, 400);
        const double force = dot(test.top().force, down);
        CHECK(force == Approx(field.load * way).epsilon(1e-3));
        CHECK(norm(test.top().turn - way * field.of_plate(1).turn) < 1e-3 * norm(test.top().turn));
        const SolidPartState found = elastic_part_state(Seated(rigid, true).s, test.parts, dt);
        CHECK(found.load / found.way == Approx(field.load).epsilon(1e-3));

        Seated soft(rigid, true);
        set_machine(soft.s, 1, machine);
        soft.drive(way, 400);
        CHECK(dot(soft.top().force, down) == Approx(0.5 * field.load * way).epsilon(1e-3));
        CHECK(norm(soft.moment()) < 1e-9 * force * a);
        Seated begun(rigid, true);
        set_machine(begun.s, 1, machine);
        const SolidPartState half = elastic_part_state(begun.s, begun.parts, dt);
        const Vector turn = (1.0 / half.way) * half.state.plates[1].turn;
        CHECK(norm(turn - (1.0 / way) * soft.top().turn) < 1e-3 * norm(turn));
    }
}

TEST_CASE("A seat of space follows grains in the growth of a load", "[solids]")
{
    for (const bool soft : { false, true }) {
        Seated test(false, true);
        const SolidDrive drive = drive_of(test.parts);
        const SolidField whole = elastic_field(test.s, drive);
        if (soft) set_machine(test.s, 1, whole.load);
        start(test.s, drive, elastic_field(test.s, drive), 0.0, 1e-9 * a, true, dt);
        const double rate = part_load_rate(test.s, test.parts, loading_field(test.s));
        CHECK(rate == Approx((soft ? 0.5 : 1.0) * whole.load * 1e-9 * a).epsilon(1e-3));
        test.go(200);
        CHECK(dot(test.top().force, down) == Approx(200.0 * rate).epsilon(0.02));
    }
}

TEST_CASE("A seated plate of space that is pressed bears its load alone", "[solids]")
{
    for (const bool rigid : { false, true }) {
        for (const bool bonded : { false, true }) {
            Seated test(rigid, bonded);
            free_plate(test.s, 1);
            scale_masses(test.s, damping, dt);
            const SolidPartState linear = pressed_part_state(test.s, {}, { { 1, 1e6 } });
            press(test.s, 1, 1e6);
            test.go(3000);  // 2000 bring it to rest
            const double load = 1e6 * test.top().face_area;
            const Vector turn = (1.0 / linear.way) * linear.state.plates[1].turn;
            CHECK(dot(test.top().force, down) == Approx(load).epsilon(1e-3));
            CHECK(norm(test.moment()) < 1e-9 * load * a);
            CHECK(norm(test.top().turn - turn) < 0.02 * norm(turn));
        }
    }
}

TEST_CASE("A seated plate of space is laid down on what is before it", "[solids]")
{
    SolidState s = make_solid(box(40, 3).cells, box(40, 3).solid, granite());
    const Vector top = box(40, 3).solid.high;
    const double along_x = 0.05, along_y = -0.03;
    for_each_node(s, [&](int grain, int number) {
        const int node = s.grains.node(grain, number);
        Vector x = space_vector(s.grains.reference, node);
        x.z += (x.z / top.z) * (along_x * x.x + along_y * x.y);
        set_space_vector(s.grains.reference, node, x);
    });
    SolidPatch patch { down, { -a, -a, top.z - a }, { top.x + a, top.y + a, top.z + a } };
    patch.seated = true;
    const Plate& p = s.plates[add_patch_plate(s, patch)];
    CHECK(p.turn.y == Approx(-along_x).epsilon(1e-9));
    CHECK(p.turn.x == Approx(along_y).epsilon(1e-9));
    for (const PlatePoint& point : p.points)
        CHECK(std::fabs(point.opening) < 1e-12 * a);
}

TEST_CASE("A seated plate of space lies on three contacts around its seat", "[solids]")
{
    Random random(7);
    const auto [solid, cells] = disc();
    for (int draw = 0; draw < 20; ++draw) {
        SolidState s = make_solid(cells, solid, granite());
        const double angle = 2.0 * pi * random.next();
        SolidPatch patch { { std::cos(angle), 0.0, std::sin(angle) }, solid.low, solid.high };
        patch.seated = true;
        const Plate& p = s.plates[add_patch_plate(s, patch)];
        const auto [first, second] = seat_axes(p.normal);
        int touching = 0;
        double least[] = { 1.0, 1.0, 1.0, 1.0 };
        for (int i = 0; i < plate_points(p); ++i) {
            REQUIRE(p.points[i].opening > -1e-9 * a);
            if (p.points[i].opening > 1e-9 * a) continue;
            ++touching;
            const double x = dot(point_arm(p, i), first), y = dot(point_arm(p, i), second);
            const double ways[] = { x, -x, y, -y };
            for (int k = 0; k < 4; ++k)
                least[k] = std::min(least[k], ways[k]);
        }
        CHECK(touching >= 3);
        CHECK(std::count_if(p.points.begin(), p.points.end(), [](const PlatePoint& point) {
            return point.opening <= 0.0;
        }) == touching);
        CHECK(dot(p.normal, p.position) < 0.0);
        CHECK(*std::max_element(least, least + 4) <= 0.0);
        SolidPatch fixed = patch;
        fixed.seated = false;
        CHECK(find_patch_plate(s, patch) == 0);
        CHECK(find_patch_plate(s, fixed) == -1);
    }
}

TEST_CASE("A seated plate of space asks for contacts around its middle", "[solids]")
{
    SolidState s = make_solid(box(40, 3).cells, box(40, 3).solid, granite());
    const Vector top = box(40, 3).solid.high;
    SolidPatch patch { down, { 0.0, 0.0, top.z - a }, { 0.01 * a, 0.01 * a, top.z + a } };
    patch.seated = true;
    CHECK_THROWS_WITH(add_patch_plate(s, patch), Catch::Contains("contacts of a seated plate"));
}

TEST_CASE("Contacts in a line leave a plate's other turn at rest", "[plate]")
{
    const auto balance = [](const std::vector<SoftContact>& springs, Vector load) {
        PlateStiffness stiffness;
        for (const SoftContact& c : springs)
            stiffness.add(c.stiffness, c.opens);
        const Vector motion = stiffness.moved_by(load);
        for (const SoftContact& c : springs)
            load = load - c.stiffness * dot(c.opens, motion) * c.opens;
        return std::pair { motion, norm(load) };
    };
    const Vector one { 1.0, 3.0, -1.0 }, two { 1.0, -6.0, 2.0 }, aside { 1.0, 0.0, 4.0 };
    CHECK(balance({ { 0.0, 2.0, one } }, 4.0 * one).second < 1e-12);
    const auto [line, missing] = balance({ { 0.0, 2.0, one }, { 0.0, 5.0, two } }, one - two);
    CHECK(missing < 1e-12);
    CHECK(line.z == 0.0);
    CHECK(line.y != 0.0);
    // the second turn alone can bear what these ask for
    const Vector near { 1.0, -1e-3, -1e-3 }, far { 1.0, -1e-3, 2e-3 };
    CHECK(balance({ { 0.0, 1.0, near }, { 0.0, 1.0, far } }, near - far).second < 1e-12);
    const auto three =
        balance({ { 0.0, 2.0, one }, { 0.0, 5.0, two }, { 0.0, 1.0, aside } }, { 1.0, -2.0, 3.0 });
    CHECK(three.second < 1e-12);
    // a contact that lies beside one axis turns the plate about the other
    for (const double beside : { 1e-6, 1e-9, 1e-15 }) {
        const SoftPlate plate { 0.0, 0.0, false, { { -1e-8, 1.0, { 0.0, beside, 1e-3 } } } };
        CHECK(norm(plate.least()) == Approx(1e-5));
    }
}
