// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  A plate of space in a soft machine: springs in series, energies, the linear start.
#include "support/catch.hpp"

#include <flexpm/kernel/laboratory/gauge.hpp>
#include <flexpm/kernel/laboratory/solid_drive.hpp>
#include <flexpm/kernel/laboratory/solid_parts.hpp>
#include <flexpm/kernel/parts/solid_jaws.hpp>
#include <flexpm/kernel/parts/solid_patches.hpp>
#include <flexpm/kernel/parts/solid_plates.hpp>

#include "support/solid_states.hpp"

using namespace solid_states;

namespace {

constexpr double damping = 0.7, dt = 1.0, a = solid_samples::side;
constexpr Vector down { 0.0, 0.0, -1.0 };

/// A box between platens, the lower one 0.
struct Pressed {
    SolidState s;
    PartGeometry parts;

    Pressed(const Packing& p, bool rigid, bool bonded) :
        s(make_solid(p.cells, p.solid, granite(FacePointRule::corners_and_inner, rigid)))
    {
        const Vector top = p.solid.high, beyond { top.x + a, top.y + a, top.z + a };
        add_patch_plate(s, { -1.0 * down, { -a, -a, -a }, { beyond.x, beyond.y, a }, 0.5 });
        add_patch_plate(s, { down, { -a, -a, top.z - a }, beyond, 0.0, bonded });
        scale_masses(s, damping, dt);
        parts = { { 1 }, { 0 }, down, top.x * top.y, top.z };
    }

    void go(int steps)
    {
        for (int k = 0; k < steps; ++k)
            step(s, { dt, damping, 1, true });
    }
    double stiffness() const
    {
        const TestScales scales = solid_part_scales(s, parts, 0.0, dt);
        return scales.modulus * parts.area / parts.length;
    }
    double imbalance() const
    {
        const Energies e = energies(s);
        return e.kinetic + e.elastic + e.damage + e.friction + e.damping + e.drag - e.boundary_work
            - e.initial;
    }
};

}  // namespace

TEST_CASE(
    "A plate of space in a soft machine bears in series with its spring", "[solids][many_steps]")
{
    const Packing p = box(40, 3);
    for (const bool rigid : { false, true }) {
        for (const double part : { 0.1, 1.0, 10.0 }) {
            Pressed test(p, rigid, false);
            const double specimen = test.stiffness(), machine = part * specimen;
            set_machine(test.s, 1, machine);
            CHECK(test.stiffness() == Approx(specimen).epsilon(1e-12));
            const double way = 1e-6 * test.parts.length;
            const double series = 1.0 / (1.0 / specimen + 1.0 / machine);
            const SolidDrive drive = drive_of(test.parts);
            start(test.s, drive, elastic_field(test.s, drive), 0.0, way / 400, true, dt);
            const double before = crosshead_way(test.s, 1, down);
            test.go(400);
            CHECK(crosshead_way(test.s, 1, down) - before == Approx(way).epsilon(1e-9));
            go_on(test.s, drive, 0.0, dt);
            test.go(3000);
            const Plate& plate = test.s.plates[1];
            const double force = dot(plate.force, down), pushed = dot(plate.displacement, down);
            // contacts of a flat end that pull at first are not those of the linear solution
            CHECK(force == Approx(series * way).epsilon(0.01));
            CHECK(force == Approx(machine * (way - pushed)).epsilon(1e-9));
            CHECK(machine_energy(test.s, 1) == Approx(0.5 * force * force / machine).epsilon(1e-9));
            const Energies e = energies(test.s);
            CHECK(std::fabs(test.imbalance()) < 1e-4 * e.elastic);
            CHECK(e.boundary_work == Approx(0.5 * force * pushed).epsilon(0.02));
        }
    }
}

TEST_CASE("Grains begin to move as those before a plate that gives way", "[solids]")
{
    const Packing p = box(40, 3);
    for (const bool rigid : { false, true }) {
        Pressed test(p, rigid, true);
        const double specimen = test.stiffness(), machine = 0.5 * specimen;
        set_machine(test.s, 1, machine);
        const SolidDrive drive = drive_of(test.parts);
        const double velocity = 1e-9 * test.parts.length;
        start(test.s, drive, elastic_field(test.s, drive), 0.0, velocity, true, dt);
        const Array<double> field = loading_field(test.s);
        CHECK(crosshead_rate(test.s, 1, down) == Approx(velocity));
        CHECK(plate_rate(test.s, 1, down, field) == Approx(velocity / 3.0).epsilon(0.01));
        CHECK(part_load_rate(test.s, test.parts, field)
            == Approx(velocity * specimen / 3.0).epsilon(0.01));
        // no wave: the load grows as it begins to
        test.go(100);
        const double early = dot(test.s.plates[1].force, down);
        test.go(100);
        CHECK(dot(test.s.plates[1].force, down) == Approx(2.0 * early).epsilon(0.01));
        CHECK(early == Approx(100.0 * velocity * specimen / 3.0).epsilon(0.02));
    }
}

TEST_CASE("A jaw in a soft machine is where its spring and its contacts balance", "[solids]")
{
    const bool rigid = GENERATE(false, true);
    const double friction = GENERATE(0.0, 0.3);
    SolidState s =
        make_solid(disc().cells, disc().solid, granite(FacePointRule::corners_and_inner, rigid));
    const Vector up { 0.0, 0.0, 1.0 };
    add_jaw_plate(s, { down, 1.5, 1.0, 0.3 });
    const int top = add_jaw_plate(s, { up, 1.0, 1.0, friction });
    scale_masses(s, damping, dt);
    const PartGeometry parts { { top }, { 0 }, down, a * a, a };
    const double machine = 0.5 * solid_part_scales(s, parts, 1e6, dt).modulus * parts.area / a;
    set_machine(s, top, machine);
    const SolidDrive drive = drive_of(parts);
    // a start in mid-way has the energy of its forces, and no work of the boundary
    start(s, drive, elastic_field(s, drive), 1e-5 * a, 0.0, true, dt);
    CHECK(energies(s).boundary_work == 0.0);
    const double before = crosshead_way(s, top, down);
    CHECK(before == Approx(1e-5 * a).epsilon(1e-9));
    go_on(s, drive, 2.5e-6 * a, dt);
    for (int k = 0; k < 400; ++k) {
        step(s, { dt, damping, 1, true });
        const Plate& plate = s.plates[top];
        REQUIRE(machine * plate.machine_give
            == Approx(dot(plate.force, plate.normal)).epsilon(1e-9).margin(1e-12));
    }
    CHECK(crosshead_way(s, top, down) - before == Approx(1e-3 * a).epsilon(1e-9));
    CHECK(s.plates[top].machine_give > 0.1 * 1e-3 * a);
    const Energies e = energies(s);
    CHECK(std::fabs(e.kinetic + e.elastic + e.damage + e.friction + e.damping + e.drag
              - e.boundary_work - e.initial)
        < 1e-3 * e.elastic);
    double rubs = 0.0;
    for (int i = 0; i < plate_points(s.plates[top]); ++i)
        rubs += norm(point_shear(s.plates[top], i));
    CHECK((rubs > 0.0) == (friction > 0.0));
}

TEST_CASE("A crosshead of space that goes back takes the plate off", "[solids]")
{
    Pressed test(box(40, 3), false, false);
    set_machine(test.s, 1, test.stiffness());
    test.s.plates[1].velocity = 1e-9 * a * Vector { 0.0, 0.0, 1.0 };
    test.go(100);
    CHECK(norm(test.s.plates[1].force) == 0.0);
    CHECK(std::fabs(test.s.plates[1].machine_give) < 1e-20);
    CHECK(test.s.plates[1].displacement.z == Approx(1e-7 * a));
}

TEST_CASE("What is no soft machine is refused", "[solids]")
{
    Pressed test(box(40, 3), true, false);
    CHECK_THROWS_WITH(set_machine(test.s, 2, 1e6), Catch::Contains("plate = 2, must be the index"));
    CHECK_THROWS_WITH(
        set_machine(test.s, 1, 0.0), Catch::Contains("stiffness of a machine = 0 N/m"));
    set_machine(test.s, 1, 1e6);
    CHECK_THROWS_WITH(set_machine(test.s, 1, 1e6), Catch::Contains("must be given once"));
    const SolidDrive both { { 0, 1 }, down };
    CHECK_THROWS_WITH(start(test.s, both, elastic_field(test.s, both), 0.0, 1e-9, true, dt),
        Catch::Contains("driven plates with a soft machine = 2, must be 1"));
}
