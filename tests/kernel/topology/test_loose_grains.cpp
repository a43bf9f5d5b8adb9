// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Grains that have come loose from a specimen are not pressed, deviation D57.
#include "support/catch.hpp"

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/assembly/state_check.hpp>
#include <flexpm/kernel/forces/gravity.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/measure/grain_parting.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/topology/contact_update.hpp>
#include <flexpm/kernel/topology/loose_grains.hpp>
#include <flexpm/kernel/topology/plate_build.hpp>

#include "support/balance.hpp"
#include "support/driven.hpp"
#include "support/solid_states.hpp"

using namespace driven;
using flexpm::GrainPair;

namespace {

constexpr double size = 3e-3;      // [m]
constexpr double pressure = 12e6;  // [Pa]

using Loose = std::vector<std::uint8_t>;

/// Square grains in a row, pressed on their right side; nothing is held.
Assembly row(int grains, bool rigid = false)
{
    auto o = specimens::options(specimens::strong_contact());
    o.rigid = rigid;
    Assembly a = specimens::assemble(specimens::grid(grains, 1, size), o);
    flexpm::scale_masses(a, 0.7);
    flexpm::reset_energy_balance(a);
    flexpm::set_pressure(a, flexpm::right_side, pressure);
    return a;
}

void hold(Assembly& a, int grain)
{
    flexpm::for_each_component(a.grains, grain, [&](int i) { a.grains.prescribed[i] = 1; });
}

void part(Assembly& a, int contact) { flexpm::change_contacts(a, { contact }, {}, 0.7, 1.0); }

double pressed_force(const Assembly& a)
{
    double sum = 0.0;
    for (int e = 0; e < a.facets.count; ++e)
        sum += std::fabs(
            a.facets.forces[flexpm::Facets::force_index(e, flexpm::FacetRow::of_pressure)]);
    return sum;
}

}  // namespace

TEST_CASE("Grains that no contact joins to what is held are not pressed until they touch again")
{
    Assembly a = row(4);
    hold(a, 0);
    run(a, 1);
    flexpm::find_loose(a);
    CHECK(a.grains.loose == Loose { 0, 0, 0, 0 });
    const double whole = pressed_force(a);
    CHECK(whole == Approx(0.5 * pressure * size * specimens::thickness).epsilon(1e-6));
    part(a, 1);
    flexpm::find_loose(a);
    CHECK(a.grains.loose == Loose { 0, 0, 1, 1 });  // one group
    run(a, 1);
    CHECK(pressed_force(a) == 0.0);
    flexpm::change_contacts(a, {}, { GrainPair { 1, 2 } }, 0.7, 1.0);
    flexpm::find_loose(a);
    CHECK(a.grains.loose == Loose { 0, 0, 0, 0 });
    run(a, 1);
    CHECK(pressed_force(a) == Approx(whole).epsilon(1e-3));
}

TEST_CASE("A bond that has cracked and still touches holds its grains to the specimen")
{
    auto o = specimens::options(specimens::granite_contact());
    Assembly a = specimens::assemble(specimens::grid(2, 1, size), o);
    hold_all(a);
    flexpm::set_pressure(a, flexpm::right_side, pressure);
    const auto release = [&] {
        flexpm::for_each_component(a.grains, 1, [&](int i) { a.grains.prescribed[i] = 0; });
        flexpm::find_loose(a);
    };
    driven::set_velocity(a, 1, Point { 5e-9, 0.0 });
    run(a, 2000);
    REQUIRE(flexpm::count_cracks(a).tensile == 3);
    release();
    CHECK(a.grains.loose == Loose { 0, 1 });  // faces that are near and do not touch (D59)
    hold(a, 1);
    driven::set_velocity(a, 1, Point { -5e-9, 0.0 });
    run(a, 2000);
    release();
    CHECK(a.grains.loose == Loose { 0, 0 });
}

TEST_CASE("Where nothing is held the largest group stands; without a pressure none is loose")
{
    Assembly a = row(3);
    part(a, 0);
    flexpm::find_loose(a);
    CHECK(a.grains.loose == Loose { 1, 0, 0 });
    flexpm::set_pressure(a, flexpm::right_side, 0.0);
    flexpm::find_loose(a);
    CHECK(a.grains.loose == Loose { 0, 0, 0 });
}

TEST_CASE("The energies balance as a grain comes loose")
{
    for (bool rigid : { false, true }) {
        CAPTURE(rigid);
        Assembly a = row(3, rigid);
        hold(a, 0);
        // strains so small that large displacements add nothing to the trapezoids of the works
        flexpm::set_pressure(a, flexpm::right_side, 1e-6 * pressure);
        flexpm::StepOptions o;
        o.damping = 0.7;
        o.measure = true;
        double miss = 0.0;
        part(a, 1);  // a bond that bears nothing: it takes no energy along
        for (int i = 0; i < 60; ++i) {
            if (i == 20) flexpm::find_loose(a);
            flexpm::step(a, o);
            miss = std::max(miss, std::fabs(balance::miss(flexpm::energies(a))));
        }
        CHECK(a.grains.loose == Loose { 0, 0, 1 });
        CHECK(a.ledger.pressure_work > 0.0);
        CHECK(miss < 1e-10 * a.ledger.pressure_work);
    }
}

TEST_CASE("A plate whose grains are all loose is pressed no more, and does not hold them")
{
    for (bool rigid : { false, true }) {
        CAPTURE(rigid);
        Assembly a = row(3, rigid);
        hold(a, 0);
        flexpm::set_pressure(a, flexpm::right_side, 0.0);
        const int plate = flexpm::add_side_plates(a, flexpm::right_side, 1, {})[0];
        flexpm::scale_masses(a, 0.7);
        flexpm::press(a, plate, pressure);
        run(a, 10, 0.7);
        part(a, 1);
        flexpm::find_loose(a);
        CHECK(a.grains.loose == Loose { 0, 0, 1 });
        run(a, 1, 0.7);  // the second half of the last step's work falls into this one
        const double work = a.plates[plate].boundary_work;
        run(a, 10, 0.7);
        CHECK(a.plates[plate].boundary_work == work);
        CHECK(a.plates[plate].unbalanced == pressure * size * specimens::thickness);
        flexpm::change_contacts(a, {}, { GrainPair { 1, 2 } }, 0.7, 1.0);
        flexpm::find_loose(a);
        run(a, 10, 0.7);
        CHECK(a.plates[plate].boundary_work != work);
    }
}

TEST_CASE("Grains that touch a plate which is held are not loose")
{
    Assembly a = row(3);
    hold(a, 0);
    flexpm::add_side_plates(a, flexpm::top_side, 1, {});
    part(a, 1);
    flexpm::find_loose(a);
    CHECK(a.grains.loose == Loose { 0, 0, 0 });
    for (flexpm::PlatePoint& point : a.plates[0].points)
        point.opening = 1e-9;
    flexpm::find_loose(a);
    CHECK(a.grains.loose == Loose { 0, 0, 1 });
}

TEST_CASE("Grains part by what the distances between those once bonded have grown")
{
    Assembly a = row(3);
    hold_all(a);
    driven::set_velocity(a, 1, Point { 1e-9, 0.0 });
    driven::set_velocity(a, 2, Point { 3e-9, 0.0 });
    run(a, 100);
    const flexpm::Parting together = flexpm::find_parting(a);
    CHECK(together.any == Approx(2e-7).epsilon(1e-6));
    CHECK(together.standing == together.any);
    CHECK(together.loose == 0);
    a.grains.loose[2] = 1;
    const flexpm::Parting apart = flexpm::find_parting(a);
    CHECK(apart.any == together.any);
    CHECK(apart.standing == Approx(1e-7).epsilon(1e-6));
    CHECK(apart.loose == 1);
    flexpm::check_state(a);
    a.grains.loose.pop_back();
    CHECK_THROWS_WITH(flexpm::check_state(a), Catch::Contains("values of grains"));
}

TEST_CASE("A grain that gravity pulls from a solid is loose")
{
    for (bool rigid : { false, true }) {
        CAPTURE(rigid);
        flexpm::SolidState s = flexpm::make_solid(solid_samples::brick(1, 1, 3),
            flexpm::Solid::box(size, size, 3.0 * size),
            solid_states::granite(flexpm::FacePointRule::corners_and_inner, rigid));
        s.grains.prescribed[s.grains.component(s.grains.centre(2), 2)] = 1;
        const int low = s.contacts.pairs[0][0] == 0 ? 0 : 1;
        for (int p = 0; p < s.contacts.points_of(low); ++p)
            s.contacts.set_crack(low, p, { 0, flexpm::tensile_crack, {}, 0.0 });
        // the crack is open
        for (int n = 0; n < s.grains.nodes_of(0); ++n)
            s.grains.displacement[s.grains.component(s.grains.node(0, n), 2)] = -1e-6;
        flexpm::find_loose(s);
        CHECK(s.grains.loose == Loose { 0, 0, 0 });  // neither pressure nor weight
        flexpm::set_gravity(s, { 0.0, 0.0, -9.81 });
        flexpm::find_loose(s);
        CHECK(s.grains.loose == Loose { 1, 0, 0 });
    }
}
