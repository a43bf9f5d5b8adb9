// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Contacts that end and begin while grains move far, paper Sec. 2.3. Tension positive.
#include "support/catch.hpp"

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/topology/contact_search.hpp>
#include <flexpm/kernel/topology/contact_update.hpp>
#include <flexpm/kernel/topology/erasure.hpp>
#include <flexpm/kernel/view/snapshot.hpp>

#include "support/driven.hpp"
#include "support/law_path.hpp"

using namespace driven;
using flexpm::GrainPair;

namespace {

constexpr double size = 3e-3;  // [m]

/// Three held square grains in a row; the last one can be moved.
Assembly row_of_three()
{
    Assembly a = specimens::assemble(
        specimens::grid(3, 1, size), specimens::options(specimens::granite_contact()));
    hold_all(a);
    return a;
}

/// Move a grain by `way` in `steps`.
void move(Assembly& a, int grain, Point way, int steps)
{
    set_velocity(a, grain, (1.0 / steps) * way);
    run(a, steps);
    set_velocity(a, grain, Point { 0.0, 0.0 });
}

/// Move the last grain along x.
void move_last(Assembly& a, double way, int steps) { move(a, 2, { way, 0.0 }, steps); }

/// The same with the last bond torn, apart and taken out, and a new contact of the last two grains,
/// number 2, in its place.
Assembly row_with_touch()
{
    Assembly a = row_of_three();
    move_last(a, 1e-5, 2000);
    flexpm::change_contacts(a, { 1 }, {}, 0.7, 1.0);
    move_last(a, -1e-5, 2000);
    flexpm::change_contacts(a, {}, { GrainPair { 1, 2 } }, 0.7, 1.0);
    return a;
}

double booked(const flexpm::Energies& e)
{
    return e.elastic + e.damage + e.friction - e.boundary_work - e.initial;
}

}  // namespace

TEST_CASE("A pulled bond ends when cracked and apart; its cracks and losses stay on record")
{
    Assembly a = row_of_three();
    CHECK_FALSE(flexpm::has_ended(a, 1));
    move_last(a, 1e-5, 2000);
    REQUIRE(flexpm::has_ended(a, 1));
    CHECK_FALSE(flexpm::has_ended(a, 0));
    const double damage = flexpm::energies(a).damage;
    flexpm::change_contacts(a, { 1 }, {}, 0.7, 1.0);
    CHECK(a.contacts.count == 2);
    CHECK(flexpm::count_cracks(a).tensile == 3);
    CHECK(flexpm::energies(a).damage == Approx(damage).epsilon(1e-12));
    CHECK_FALSE(flexpm::has_ended(a, 1));  // it has ended already
    move_last(a, -2e-5, 200);
    CHECK(std::fabs(resultant(a, 2).x) < 1e-12);
}

TEST_CASE("A new contact starts without force or energy, presses with K_n and never pulls")
{
    Assembly a = row_of_three();
    move_last(a, 1e-5, 2000);
    flexpm::change_contacts(a, { 1 }, {}, 0.7, 1.0);
    move_last(a, -1e-5, 2000);
    const double before = booked(flexpm::energies(a));
    const GrainPair pair { 1, 2 };
    flexpm::change_contacts(a, {}, { pair }, 0.7, 1.0);
    REQUIRE(a.contacts.count == 3);
    CHECK(a.contacts.pairs[2] == pair);
    CHECK_FALSE(a.contacts.bonded[2]);
    CHECK(booked(flexpm::energies(a)) == Approx(before).margin(1e-15));
    CHECK(flexpm::count_cracks(a).tensile == 3);

    const auto m = specimens::granite_contact();
    const double area = size * specimens::thickness, press = 1e-7;
    move_last(a, -press, 50);
    const double force = m.normal_stiffness * press * area;
    CHECK(std::fabs(resultant(a, 2).x) == Approx(force).epsilon(1e-4));
    move_last(a, 3.0 * press, 50);
    CHECK(std::fabs(resultant(a, 2).x) < 1e-9);
    CHECK(flexpm::has_ended(a, 2));
    flexpm::change_contacts(a, { 2 }, {}, 0.7, 1.0);
    CHECK(a.contacts.count == 2);
    // a driven velocity that changes is booked half a step late: force times change times dt / 2
    const double late = 0.5 * force * 4.0 * press / 50.0;
    CHECK(booked(flexpm::energies(a)) == Approx(before).margin(1.1 * late));
}

TEST_CASE("A new contact has the residual friction at once")
{
    Assembly a = row_of_three();
    for (flexpm::LawParameters& law : a.contacts.laws) {
        law.residual_friction = 0.5 * law.friction;
        law.friction_fall = law.residual_friction / 1e-4;
    }
    move_last(a, 1e-5, 2000);
    flexpm::change_contacts(a, { 1 }, {}, 0.7, 1.0);
    move_last(a, -1e-5, 2000);
    flexpm::change_contacts(a, {}, { { 1, 2 } }, 0.7, 1.0);
    const double whole = a.contacts.law_of(2).friction;
    for (int p = 0; p < a.contacts.points_of(2); ++p) {
        CHECK(flexpm::friction_of(a.contacts, 2, p) == Approx(0.5 * whole).epsilon(1e-14));
        CHECK(flexpm::friction_of(a.contacts, 0, p) == whole);
    }
}

TEST_CASE("Contacts keep their numbers while others come and go, and no number is given twice")
{
    Assembly a = row_of_three();
    REQUIRE(a.contacts.id == std::vector<int> { 0, 1 });
    const GrainPair touching { 0, 2 };
    flexpm::change_contacts(a, {}, { touching }, 0.7, 1.0);
    REQUIRE(a.contacts.pairs[1] == touching);  // between the two bonds
    CHECK(a.contacts.id == std::vector<int> { 0, 2, 1 });
    for (int contact = 0; contact < 3; ++contact)
        CHECK(flexpm::contact_with_id(a, a.contacts.id[contact]) == contact);
    CHECK(flexpm::take_snapshot(a).contact == std::vector<std::int32_t> { 0, 2, 1 });
    flexpm::change_contacts(a, { 1 }, {}, 0.7, 1.0);
    CHECK(a.contacts.id == std::vector<int> { 0, 1 });
    CHECK(flexpm::contact_with_id(a, 2) == -1);
    flexpm::change_contacts(a, {}, { touching }, 0.7, 1.0);
    CHECK(a.contacts.id == std::vector<int> { 0, 3, 1 });
    CHECK(flexpm::contact_with_id(a, -1) == -1);
    CHECK(flexpm::contact_with_id(a, 4) == -1);
}

TEST_CASE("A new contact follows the place where the discs touch, without energy")
{
    Assembly a = row_with_touch();
    move_last(a, -1e-7, 50);
    CHECK_FALSE(flexpm::follow_touches(a, 0.7, 1.0));  // still in the middle of the edges
    set_velocity(a, 2, flexpm::Point { 0.0, 1e-6 });
    run(a, 600);  // 0.6 mm up: the place climbs by 0.3 mm on one grain and sinks on the other
    const double stored = flexpm::energies(a).elastic;
    REQUIRE(flexpm::follow_touches(a, 0.7, 1.0));
    CHECK(flexpm::energies(a).elastic == stored);
    const double up[] = { 0.5 + 0.1, 0.5 - 0.1 };
    for (int side : { 0, 1 }) {
        const double y = flexpm::vector_on_edge(
            a.grains.reference, a.contacts.edge(2, side), a.contacts.weight(2, 0, side))
                             .y;
        CHECK(y / size == Approx(up[side]).margin(2e-3));
    }
    CHECK_FALSE(flexpm::follow_touches(a, 0.7, 1.0));
}

TEST_CASE("A new contact goes over to other edges where the grain rolls around a corner")
{
    Assembly a = row_with_touch();
    const double angle = GENERATE(30.0, 60.0) * std::acos(-1.0) / 180.0;
    // the last grain moves around the one before, whose disc it touches all the time
    move(a, 2, size * Point { std::cos(angle) - 1.0, std::sin(angle) }, 100);
    REQUIRE(flexpm::follow_touches(a, 0.7, 1.0));
    for (int side : { 0, 1 }) {
        const auto [n0, n1] = a.contacts.edge(2, side);
        const Point edge = vector_at(a.grains.reference, n1) - vector_at(a.grains.reference, n0);
        // below 45 degrees the edges that stand, above it those that lie
        CHECK((std::fabs(edge.x) > std::fabs(edge.y)) == (angle > 0.8));
        // where the discs touch: half a grain from its centre, along the line of the centres
        const Point place =
            flexpm::vector_on_edge(a.grains.reference, { n0, n1 }, a.contacts.weight(2, 0, side));
        const Point centre = vector_at(a.grains.reference, a.grains.centre(side + 1));
        const double along = std::min(std::sin(angle), std::cos(angle)) * (side == 0 ? 1.0 : -1.0);
        const Point from = place - centre;
        CHECK((angle > 0.8 ? from.x : from.y) / (0.5 * size) == Approx(along).epsilon(1e-4));
    }
}

TEST_CASE("An edge across a contact takes no couple; the force is that of the discs")
{
    // grains four times as high as wide: discs above each other touch within their cells, where the
    // edges that stand are the closest
    auto specimen = specimens::grid(2, 1, size);
    for (Point& vertex : specimen.cells.vertices)
        vertex.y *= 4.0;
    for (auto& disc : specimen.discs)
        disc.centre.y *= 4.0;
    Assembly a = specimens::assemble(specimen, specimens::options(specimens::granite_contact()));
    hold_all(a);
    flexpm::erase(a, { {}, { 0 } }, 1.0);
    move(a, 1, { -0.99 * size, size }, 100);
    flexpm::change_contacts(a, {}, { GrainPair { 0, 1 } }, 0.7, 1.0);
    CHECK(a.contacts.inverse_edge_length(1, 0) == 0.0);
    CHECK(a.contacts.inverse_edge_length(1, 1) == 0.0);
    const double press = 1e-7;
    move(a, 1, { 0.0, -press }, 50);
    // K_n times what the grains come closer, on the area of an edge
    const double force =
        specimens::granite_contact().normal_stiffness * press * 4.0 * size * specimens::thickness;
    CHECK(resultant(a, 1).y == Approx(-force).epsilon(1e-3));
}

TEST_CASE("Where masses are real, contacts that come or move do not change them")
{
    constexpr double real_masses = 0.0;  // in place of a time step
    Assembly a = row_of_three();
    move_last(a, 1e-5, 2000);
    flexpm::change_contacts(a, { 1 }, {}, 0.7, real_masses);
    move_last(a, -1e-5, 2000);
    const auto before = a.grains.inverse_mass;
    const double initial = a.ledger.initial;
    flexpm::change_contacts(a, {}, { GrainPair { 1, 2 } }, 0.7, real_masses);
    CHECK(a.grains.inverse_mass == before);
    move(a, 2, { 0.0, 0.2 * size }, 100);
    REQUIRE(flexpm::follow_touches(a, 0.7, real_masses));
    CHECK(a.grains.inverse_mass == before);
    CHECK(a.ledger.initial == initial);
}

TEST_CASE("Other contacts keep their bits when contacts change")
{
    Assembly a = row_of_three();
    set_velocity(a, 0, flexpm::Point { 1e-10, 3e-11 });
    run(a, 100);
    const flexpm::PointState state = a.contacts.point_state(0, 1);
    const flexpm::Point force = resultant(a, 0);
    flexpm::change_contacts(a, {}, { GrainPair { 0, 2 } }, 0.7, 1.0);
    REQUIRE(a.contacts.count == 3);
    CHECK(a.contacts.pairs == std::vector<GrainPair> { { 0, 1 }, { 0, 2 }, { 1, 2 } });
    CHECK(a.contacts.point_state(0, 1).opening == state.opening);
    CHECK(a.contacts.point_state(0, 1).shear_traction == state.shear_traction);
    set_velocity(a, 0, flexpm::Point { 0.0, 0.0 });
    run(a, 1);
    CHECK(resultant(a, 0).x == Approx(force.x).epsilon(1e-12));
}

TEST_CASE("Grains touch at the sum of their radii, or where their discs overlapped when bonded")
{
    Assembly a = row_of_three();
    const double radii = a.grains.radius[0] + a.grains.radius[2];
    CHECK(flexpm::touching_distance(a, { 0, 2 }) == radii);
    a.contacts.close_pairs[{ 0, 2 }] = 0.9 * radii;
    CHECK(flexpm::touching_distance(a, { 0, 2 }) == 0.9 * radii);
    CHECK(!flexpm::is_touching(a, { 0, 2 }));
    move_last(a, -1.05 * size, 10);  // from two sizes to 0.95
    CHECK(!flexpm::is_touching(a, { 0, 2 }));
    move_last(a, -0.1 * size, 10);
    CHECK(flexpm::is_touching(a, { 0, 2 }));
}

TEST_CASE("Near pairs are those that no acting contact holds")
{
    Assembly a = row_of_three();
    CHECK(flexpm::near_pairs(a, 0.1 * size).empty());  // two bonds, and the outer grains are far
    CHECK(flexpm::near_pairs(a, 1.1 * size) == std::vector<GrainPair> { { 0, 2 } });
    move_last(a, 1e-5, 2000);
    flexpm::change_contacts(a, { 1 }, {}, 0.7, 1.0);
    CHECK(flexpm::near_pairs(a, 0.1 * size) == std::vector<GrainPair> { { 1, 2 } });
}

TEST_CASE("Masses rise for a new contact, never fall, and the energy of that is booked")
{
    Assembly a = row_of_three();
    flexpm::scale_masses(a, 0.7);
    const auto before = a.grains.inverse_mass;
    set_velocity(a, 2, flexpm::Point { 1e-9, 0.0 });
    for (auto& held : a.grains.prescribed)
        held = 0;
    const double kinetic = flexpm::kinetic_of_velocities(a.grains);
    flexpm::change_contacts(a, {}, { GrainPair { 0, 2 } }, 0.7, 1.0);
    int risen = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        CHECK(a.grains.inverse_mass[i] <= before[i]);
        risen += a.grains.inverse_mass[i] < before[i];
    }
    CHECK(risen > 0);
    CHECK(a.ledger.initial
        == Approx(flexpm::kinetic_of_velocities(a.grains) - kinetic).margin(1e-30));
}

namespace {

/// Crack all points of a contact.
void crack(Assembly& a, int contact)
{
    for (int p = 0; p < a.contacts.points_of(contact); ++p)
        a.contacts.state(contact, p, &flexpm::PointState::shear_damage) = 1.0;
}

}  // namespace

TEST_CASE("A contact on a joint does not end by the distance of its grains")
{
    Assembly a = row_of_three();
    crack(a, 1);
    move_last(a, 0.1 * size, 10);
    CHECK(flexpm::ended_contacts(a) == std::vector<int> { 1 });
    a.contacts.joint[1] = 0;
    CHECK(flexpm::ended_contacts(a).empty());
}

TEST_CASE("Contacts of one pair of grains end together")
{
    Assembly a = row_of_three();
    a.contacts.pairs[0] = a.contacts.pairs[1];
    crack(a, 1);
    CHECK(flexpm::ended_contacts(a).empty());
    move_last(a, 0.1 * size, 10);
    CHECK(flexpm::has_ended(a, 1));
    CHECK(flexpm::ended_contacts(a).empty());  // the other one still holds
    crack(a, 0);
    CHECK(flexpm::ended_contacts(a) == std::vector<int> { 0, 1 });
    // a bond without area is over already and kept for its cracks alone
    for (int p = 0; p < a.contacts.points_of(0); ++p)
        a.contacts.area(0, p) = 0.0;
    CHECK(flexpm::ended_contacts(a) == std::vector<int> { 1 });
}

TEST_CASE("Grains on two sides of a joint never touch, also those that have only a corner on it")
{
    const auto touching = [](const std::vector<int>& edge_joint, GrainPair pair) {
        auto options = specimens::options();
        options.joints = { specimens::granite_contact() };
        options.edge_joint = edge_joint;
        const Assembly a = specimens::assemble(specimens::grid(2, 2, size), options);
        return flexpm::touching_distance(a, pair);
    };
    // the joint turns around grain 0, and grain 3 lies beyond its corner
    const std::vector<int> around { 0, 0, -1, -1 };
    CHECK(touching(around, { 0, 1 }) == 0.0);
    CHECK(touching(around, { 0, 3 }) == 0.0);
    CHECK(touching(around, { 1, 2 }) > 0.0);
    // the joint ends in the middle: what lies before it has no side
    const std::vector<int> ending { 0, -1, -1, -1 };
    CHECK(touching(ending, { 0, 1 }) == 0.0);
    CHECK(touching(ending, { 0, 3 }) > 0.0);
    CHECK(touching(ending, { 1, 2 }) > 0.0);
}

TEST_CASE("What lies behind the grains on a joint does not reach over it with its disc")
{
    auto options = specimens::options();
    options.joints = { specimens::granite_contact() };
    const auto rows = specimens::grid(4, 3, size);
    for (const auto& edge : rows.cells.shared_edges)
        options.edge_joint.push_back(edge.cell_a < 4 && edge.cell_b == edge.cell_a + 4 ? 0 : -1);
    auto behind = rows;
    for (int c = 8; c < 12; ++c)
        behind.discs[c].radius = 1.6 * size;  // its centre lies 1.5 sizes above the joint
    CHECK(flexpm::touching_distance(specimens::assemble(rows, options), { 0, 11 }) > 0.0);
    CHECK(flexpm::touching_distance(specimens::assemble(behind, options), { 0, 11 }) == 0.0);
}
