// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Bonds and grains that a script erases: energies to round-off, the record of cracks, and
/// that nothing else knows of them any more. SI units.
#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/random.hpp>
#include <flexpm/kernel/forces/gravity.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/measure/specimen_strain.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/plane_lanes/rigid_grain.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/topology/contact_search.hpp>
#include <flexpm/kernel/topology/contact_update.hpp>
#include <flexpm/kernel/topology/erasure.hpp>
#include <flexpm/kernel/topology/plate_build.hpp>
#include <flexpm/kernel/view/snapshot.hpp>

#include "support/catch.hpp"

#include "support/balance.hpp"
#include "support/driven.hpp"

#include <tuple>

using namespace driven;
using flexpm::Erasure;
using flexpm::GrainPair;

namespace {

constexpr double size = 3e-3;   // of a grain [m]
constexpr double tiny = 1e-17;  // [m]: strains of 1e-14 leave all but the law linear to that order
constexpr double damping = 0.1;

Assembly grid(bool rigid)
{
    auto o = specimens::options();
    o.rigid = rigid;
    return specimens::assemble(specimens::grid(4, 3, size), o);
}

void shake(Assembly& a, double speed)
{
    flexpm::Random random(5);
    const auto next = [&] { return speed * (2.0 * random.next() - 1.0); };
    for (int g = 0; g < a.grains.count; ++g) {
        if (a.grains.is_rigid(g)) {
            const double x = next(), y = next(), spin = next() / size;
            flexpm::set_motion(a.grains, g, { x, y }, spin, 1.0);
        } else {
            set_velocity(a, g, [&](Point) {
                const double x = next(), y = next();
                return Point { x, y };
            });
        }
    }
}

/// Steps that are all measured; the largest miss of the balance over the largest energy put in.
double largest_miss(Assembly& a, int steps, double dt = 1.0)
{
    flexpm::StepOptions o;
    o.damping = damping;
    o.dt = dt;
    o.measure = true;
    double worst = 0.0;
    for (int i = 0; i < steps; ++i) {
        flexpm::step(a, o);
        const flexpm::Energies e = flexpm::energies(a);
        worst = std::max(
            worst, std::fabs(balance::miss(e)) / std::max(std::fabs(e.boundary_work), e.initial));
    }
    return worst;
}

/// The balance before, just after and long after an erasure that takes at least `least` of the
/// energy.
void check_balance(Assembly& a, const Erasure& what, double least, double dt = 1.0)
{
    largest_miss(a, 1, dt);  // a weight acts from the first step on
    flexpm::reset_energy_balance(a);
    REQUIRE(largest_miss(a, 12, dt) < 1e-10);
    const double before = balance::miss(flexpm::energies(a));
    flexpm::erase(a, what, dt);
    const flexpm::Energies now = flexpm::energies(a);
    const double most = std::max(std::fabs(now.boundary_work), now.initial);
    CHECK(std::fabs(balance::miss(now) - before) < 1e-12 * most);
    CHECK(largest_miss(a, 1, dt) < 1e-9);
    CHECK(std::fabs(flexpm::energies(a).erased) / most > least);
    CHECK(largest_miss(a, 200, dt) < 1e-9);
}

int place_of(const Assembly& a, GrainPair pair)
{
    const auto& pairs = a.contacts.pairs;
    return static_cast<int>(std::find(pairs.begin(), pairs.end(), pair) - pairs.begin());
}

/// Three held grains in a row, the last one pulled until the bond to it has softened.
Assembly softened_row()
{
    Assembly a = specimens::assemble(
        specimens::grid(3, 1, size), specimens::options(specimens::granite_contact()));
    hold_all(a);
    flexpm::reset_energy_balance(a);
    const double opening = 0.5 * a.contacts.laws[0].critical_opening;
    driven::set_velocity(a, 2, flexpm::Point { opening / 2000, 0.0 });
    run(a, 2000);
    return a;
}

}  // namespace

TEST_CASE("Erasing keeps the energy balance to 1e-9", "[erasure]")
{
    const bool rigid = GENERATE(false, true);
    CAPTURE(rigid);
    Assembly a = grid(rigid);
    SECTION("a bond")
    {
        flexpm::scale_masses(a, damping);
        shake(a, tiny);
        check_balance(a, { {}, { place_of(a, { 5, 6 }) } }, 1e-3);
    }
    SECTION("a grain and a bond elsewhere")
    {
        flexpm::scale_masses(a, damping);
        shake(a, tiny);
        check_balance(a, { { 5 }, { place_of(a, { 7, 11 }) } }, 1e-2);
    }
    SECTION("a grain on which a pressure acts")
    {
        flexpm::scale_masses(a, damping);
        flexpm::set_pressure(a, flexpm::right_side, 25.8e9 * tiny / size);
        check_balance(a, { { 3 }, {} }, 1e-3);
    }
    SECTION("a driven grain")
    {
        if (rigid) return;
        flexpm::scale_masses(a, damping);
        flexpm::prescribe(a, flexpm::side_nodes(a, flexpm::bottom_side), 1, 0.0);
        flexpm::prescribe(a, flexpm::side_nodes(a, flexpm::top_side), 1, 0.1 * tiny);
        check_balance(a, { { 10 }, {} }, 1e-3);
    }
    SECTION("a grain that plates hold, one of them loaded")
    {
        flexpm::add_side_plates(a, flexpm::bottom_side, 1, { 0.0, 0.2, true });
        const int upper =
            flexpm::add_side_plates(a, flexpm::top_side, 1, { 0.0, 0.2, true }).front();
        flexpm::scale_masses(a, damping);
        flexpm::press(a, upper, 25.8e9 * tiny / size);
        check_balance(a, { { 1, 10 }, {} }, 1e-3);
        CHECK(flexpm::plate_points(a.plates[upper]) == 3 * (rigid ? 1 : 2));
        CHECK(flexpm::contact_width(a, upper) > 0.0);
    }
    SECTION("a grain with its weight")
    {
        const double dt = flexpm::set_real_masses(a, damping);
        flexpm::set_gravity(a, { 0.0, -1e-3 * tiny / (dt * dt) });
        shake(a, tiny / dt);
        check_balance(a, { { 5 }, {} }, 1e-2, dt);
    }
}

TEST_CASE("The balance keeps what a softened bond stored and what it had lost", "[erasure]")
{
    Assembly a = softened_row();
    const flexpm::Energies before = flexpm::energies(a);
    REQUIRE(before.damage > 0.1 * before.boundary_work);
    REQUIRE(flexpm::count_cracks(a).tensile == 0);
    flexpm::erase(a, { {}, { 1 } }, 1.0);
    const flexpm::Energies now = flexpm::energies(a);
    CHECK(now.damage == Approx(before.damage).epsilon(1e-12));
    CHECK(now.erased == Approx(before.elastic - now.elastic).epsilon(1e-12));
    CHECK(now.erased > 0.1 * before.boundary_work);
    CHECK(balance::miss(now) == Approx(balance::miss(before)).margin(1e-12 * before.boundary_work));
    run(a, 3000);  // far enough to crack it
    const flexpm::Energies later = flexpm::energies(a);
    CHECK(
        balance::miss(later) == Approx(balance::miss(before)).margin(1e-9 * before.boundary_work));
    CHECK(later.boundary_work == Approx(before.boundary_work).epsilon(1e-3));
    flexpm::reset_energy_balance(a);
    CHECK(flexpm::energies(a).erased == 0.0);
}

TEST_CASE("What damage took is the sum over softened, cracked and erased points", "[erasure]")
{
    const bool cracked = GENERATE(false, true);
    Assembly a = softened_row();
    const flexpm::Energies before = flexpm::energies(a);
    REQUIRE(before.damage > 0.0);
    CHECK(before.softened == before.damage);
    if (cracked) run(a, 3000);
    const double damage = flexpm::energies(a).damage;
    flexpm::erase(a, { {}, { 1 } }, 1.0);
    const flexpm::Energies after = flexpm::energies(a);
    CHECK(after.softened == 0.0);
    double on_record = 0.0;
    for (double energy : flexpm::take_snapshot(a).erased.crack_energy)
        on_record += energy;
    CHECK(after.damage == Approx(damage).epsilon(1e-12));
    CHECK(on_record == Approx(damage).epsilon(1e-12));
    flexpm::reset_energy_balance(a);
    for (double energy : a.contacts.crack_energies)
        CHECK(energy == 0.0);
}

TEST_CASE("An erased bond is on record as erased and never cracks", "[erasure]")
{
    Assembly a = softened_row();
    const Point place = flexpm::contact_end(a, 1, 0);
    flexpm::erase(a, { {}, { 1 } }, 1.0);
    run(a, 3000);
    CHECK(flexpm::count_cracks(a).tensile + flexpm::count_cracks(a).shear == 0);
    CHECK_FALSE(flexpm::has_ended(a, 1));
    CHECK(resultant(a, 1).x == 0.0);
    CHECK(flexpm::count_contacts(a).between == 1);
    const auto s = flexpm::take_snapshot(a);
    CHECK(s.contact == std::vector<std::int32_t> { 0 });
    CHECK(s.erased_contact == std::vector<std::int32_t> { 1 });
    CHECK(s.erased_grains == std::vector<std::int32_t> { 1, 2 });
    CHECK(s.erased.crack_step == std::vector<std::int64_t> { 2000, 2000, 2000 });
    CHECK(s.erased.crack_mode == std::vector<std::int32_t>(3, flexpm::erased_point));
    CHECK(s.erased.crack_position[0] == Approx(place.x));
    CHECK(s.erased.crack_position[1] == Approx(place.y).margin(1e-12));
    const double way =
        0.5 * 3000 * a.grains.velocity[a.grains.node(2, 0)];  // of its middle since then
    CHECK(s.erased_ends[0] - place.x == Approx(way).epsilon(1e-6));
}

TEST_CASE("Cracks of a bond that is erased later stay cracks", "[erasure]")
{
    Assembly a = softened_row();
    run(a, 3000);
    REQUIRE(flexpm::count_cracks(a).tensile == 3);
    flexpm::erase(a, { {}, { 1 } }, 1.0);
    CHECK(flexpm::count_cracks(a).tensile == 3);
    CHECK(flexpm::take_snapshot(a).erased.crack_mode
        == std::vector<std::int32_t>(3, flexpm::tensile_crack));
}

TEST_CASE("To erase nothing, or once more, changes nothing", "[erasure]")
{
    Assembly a = softened_row();
    flexpm::erase(a, { {}, { 1 } }, 1.0);
    run(a, 1);  // a record that is made once more has another step
    const auto state = [&] {
        const auto s = flexpm::take_snapshot(a);
        return std::make_tuple(flexpm::energies(a).erased, flexpm::energies(a).damage,
            s.erased.crack_step, s.erased.crack_mode, a.contacts.areas);
    };
    const auto before = state();
    flexpm::erase(a, {}, 1.0);
    CHECK(state() == before);
    flexpm::erase(a, { {}, { 1 } }, 1.0);
    CHECK(state() == before);
    flexpm::erase(a, { { 2 }, {} }, 1.0);  // its one bond is gone already
    CHECK(state() == before);
}

TEST_CASE("A pair whose bond was erased may touch anew, under a new number", "[erasure]")
{
    Assembly a = softened_row();
    flexpm::erase(a, { {}, { 1 } }, 1.0);
    CHECK(flexpm::near_pairs(a, 0.1 * size) == std::vector<GrainPair> { { 1, 2 } });
    flexpm::change_contacts(a, {}, { { 1, 2 } }, 0.7, 1.0);
    CHECK(a.contacts.id == std::vector<int> { 0, 1, 2 });
    CHECK(flexpm::count_contacts(a).touching == 1);
    CHECK(flexpm::take_snapshot(a).contact == std::vector<std::int32_t> { 0, 2 });
    flexpm::erase(a, { {}, { 2 } }, 1.0);  // a touch leaves no record
    CHECK(a.contacts.id == std::vector<int> { 0, 1 });
    CHECK(flexpm::take_snapshot(a).erased_contact == std::vector<std::int32_t> { 1 });
}

TEST_CASE("Nothing knows of an erased grain", "[erasure]")
{
    const bool rigid = GENERATE(false, true);
    Assembly a = grid(rigid);
    flexpm::scale_masses(a, 0.7);
    const auto before = flexpm::count_grains(a.grains);
    const auto all = flexpm::take_snapshot(a);
    const auto top = flexpm::side_nodes(a, flexpm::top_side).size();
    const int gone = 9;  // in the top row
    flexpm::erase(a, { { gone }, {} }, 1.0);
    const auto count = flexpm::count_grains(a.grains);
    CHECK(count.grains == 11);
    CHECK(count.particles == 11);
    CHECK(count.nodes == before.nodes - a.grains.nodes_of(gone));
    CHECK(count.triangles == before.triangles - flexpm::triangles_of(a.grains, gone));
    CHECK(flexpm::count_contacts(a).between == a.contacts.count - 3);
    const auto s = flexpm::take_snapshot(a);
    CHECK(std::count(s.element_grain.begin(), s.element_grain.end(), gone) == 0);
    CHECK(s.positions.size() == all.positions.size() - 2 * a.grains.nodes_of(gone));
    CHECK(s.contact.size() == all.contact.size() - 3);
    CHECK(*std::max_element(s.elements.begin(), s.elements.end())
        == static_cast<int>(s.positions.size() / 2) - 1);
    CHECK(flexpm::side_nodes(a, flexpm::top_side).size() < top);
    for (const GrainPair& pair : flexpm::near_pairs(a, 2.0 * size))
        CHECK((pair[0] != gone && pair[1] != gone));

    flexpm::scale_masses(a, 0.7);
    flexpm::set_pressure(a, flexpm::top_side, 1e6);
    run(a, 100, 0.7);
    CHECK(flexpm::find_bad_number(a).empty());
    CHECK(vector_at(a.grains.displacement, a.grains.centre(gone)).y == 0.0);
    CHECK(flexpm::specimen_strain(a).axial < 0.0);
    CHECK(flexpm::set_real_masses(a, 0.7) > 0.0);
    run(a, 1, 0.7);
    CHECK(flexpm::find_bad_number(a).empty());
}

TEST_CASE("A step goes on without any grain", "[erasure]")
{
    const bool rigid = GENERATE(false, true);
    Assembly a = grid(rigid);
    flexpm::add_side_plates(a, flexpm::bottom_side, 1, {});
    flexpm::scale_masses(a, 0.7);
    flexpm::press(a, 0, 1e6);
    run(a, 10, 0.7);
    Erasure all;
    for (int g = 0; g < a.grains.count; ++g)
        all.grains.push_back(g);
    flexpm::erase(a, all, 1.0);
    CHECK(flexpm::take_snapshot(a).positions.empty());
    CHECK(flexpm::count_grains(a.grains).grains == 0);
    const flexpm::Energies e = flexpm::energies(a);
    CHECK(e.elastic == 0.0);
    CHECK(a.plates[0].force.y == Approx(0.0).margin(1e-9));
    run(a, 10, 0.7);
    CHECK(flexpm::find_bad_number(a).empty());
    CHECK(flexpm::near_pairs(a, size).empty());
    CHECK(flexpm::unbalanced_ratio(a) == 0.0);
    CHECK_THROWS_WITH(flexpm::fix_tangential(a, 0), Catch::Contains("edges at the plate"));
}
