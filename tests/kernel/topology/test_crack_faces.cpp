// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Bonds that have cracked meet again at their faces. SI units, tension positive.
#include "support/catch.hpp"

#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/measure/overlaps.hpp>
#include <flexpm/kernel/plane_lanes/bond_faces.hpp>

#include "reference/plain_step.hpp"
#include "reference/read_state.hpp"
#include "support/balance.hpp"
#include "support/contact_round.hpp"
#include "support/driven.hpp"

#include <tuple>

using namespace driven;
using flexpm::GrainPair;

namespace {

constexpr double size = 3e-3;  // of a square [m]
const auto material = specimens::granite_contact();

/// Two squares side by side whose discs have a part of the radius at which they would touch: all of
/// their motion is given.
Assembly held_pair(bool rigid, double disc)
{
    auto pair = specimens::grid(2, 1, size);
    for (auto& one : pair.discs)
        one.radius *= disc;
    auto options = specimens::options(material);
    options.rigid = rigid;
    Assembly a = specimens::assemble(pair, options);
    hold_all(a);
    std::fill(a.grains.spin_prescribed.begin(), a.grains.spin_prescribed.end(), 1);
    return a;
}

/// Move the second grain, with a look at the contacts every ten steps.
void lead(Assembly& a, Point way, int steps)
{
    set_velocity(a, 1, (1.0 / steps) * way);
    for (int i = 0; i < steps; i += 10) {
        contact_round::update_contacts(a);
        run(a, 10);
    }
    set_velocity(a, 1, Point {});
}

/// Turn the second grain about the middle of its face.
void turn(Assembly& a, double angle, int steps)
{
    const auto faces = flexpm::bond_faces(a, 0);
    const Point about = faces.start[1] + 0.5 * faces.along[1];
    for (int i = 0; i < steps; i += 10) {
        contact_round::update_contacts(a);
        for (int k = 0; k < 10; ++k) {
            aim(a, 1.0, [&](int node) {
                const Point p = a.grains.point_at(node);
                const bool second = flexpm::grain_node(a.grains, node).grain == 1;
                if (!second) return p;
                const double c = std::cos(angle / steps), s = std::sin(angle / steps);
                const Point r = p - about;
                return about + Point { c * r.x - s * r.y, s * r.x + c * r.y };
            });
            if (a.grains.is_rigid(1)) a.grains.spin[a.grains.slot[1]] = angle / steps;
            run(a, 1);
        }
    }
    set_velocity(a, 1, Point {});
    if (a.grains.is_rigid(1)) a.grains.spin[a.grains.slot[1]] = 0.0;
}

/// Sum of what all contacts exert on the first grain [N]: along x negative where they press.
Point force_on_first(const Assembly& a)
{
    Point sum;
    for (int c = 0; c < a.contacts.count; ++c)
        sum = sum + resultant(a, c);
    return sum;
}

int active_contacts(const Assembly& a)
{
    int count = 0;
    for (int c = 0; c < a.contacts.count; ++c)
        count += flexpm::is_active(a.contacts, c);
    return count;
}

const double area = size * specimens::thickness;  // [m^2]
constexpr double press = 1e-7;                    // [m]
const double pressing = material.normal_stiffness * press * area;

}  // namespace

TEST_CASE("A pair that was bonded meets again where it was bonded, whatever its discs")
{
    const auto [rigid, disc, far] = GENERATE(table<bool, double, double>({ { false, 0.87, 0.01 },
        { false, 1.0, 0.01 }, { false, 1.1, 0.01 }, { false, 0.87, 0.6 }, { false, 1.1, 0.6 },
        { true, 0.87, 0.01 }, { true, 1.1, 0.01 }, { true, 0.87, 0.6 }, { true, 1.1, 0.6 } }));
    CAPTURE(rigid, disc, far);
    Assembly a = held_pair(rigid, disc);
    lead(a, { 1e-5, 0.0 }, 2000);
    REQUIRE(flexpm::count_cracks(a).tensile == 3);
    lead(a, { far * size, 0.0 }, 1000);
    CHECK(active_contacts(a) == (far > 0.5 ? 0 : 1));
    lead(a, { -far * size, 0.0 }, 1000);
    lead(a, { -0.9e-5, 0.0 }, 100);
    CHECK(norm(force_on_first(a)) == 0.0);  // a micrometre apart
    lead(a, { -1e-6, 0.0 }, 100);
    CHECK(norm(force_on_first(a)) < 1e-3 * pressing);
    lead(a, { -press, 0.0 }, 100);
    CHECK(force_on_first(a).x == Approx(-pressing).epsilon(2e-3));
    CHECK(std::fabs(force_on_first(a).y) < 1e-6 * pressing);
    lead(a, { -press, 0.0 }, 100);
    CHECK(force_on_first(a).x == Approx(-2.0 * pressing).epsilon(2e-3));
    CHECK(flexpm::count_cracks(a).tensile == 3);
    lead(a, { 3.0 * press, 0.0 }, 100);
    CHECK(norm(force_on_first(a)) == 0.0);
}

TEST_CASE("Cracked faces slide along each other, and no force jumps where they leave each other")
{
    const bool rigid = GENERATE(false, true);
    const double disc = GENERATE(0.87, 1.1);
    CAPTURE(rigid, disc);
    Assembly a = held_pair(rigid, disc);
    lead(a, { 1e-5, 0.0 }, 2000);
    lead(a, { -1e-5 - press, 0.0 }, 2000);
    // up to half an edge nothing opens and nothing closes
    lead(a, { 0.0, 0.4995 * size }, 2000);
    CHECK(force_on_first(a).x == Approx(-pressing).epsilon(2e-3));
    CHECK(std::fabs(force_on_first(a).y) == Approx(material.friction * pressing).epsilon(2e-3));
    Point before = force_on_first(a);
    double largest = 0.0;
    set_velocity(a, 1, Point { 0.0, 1e-7 });
    for (int i = 0; i < 1000; ++i) {
        contact_round::update_contacts(a);
        run(a, 1);
        largest = std::max(largest, norm(force_on_first(a) - before));
        before = force_on_first(a);
    }
    CHECK(largest < 0.02 * pressing);
    CHECK(norm(before) < 0.02 * pressing);  // the discs have left each other
}

TEST_CASE("Faces that have turned meet with their ends, up to an angle")
{
    const bool rigid = GENERATE(false, true);
    Assembly a = held_pair(rigid, 0.87);
    lead(a, { 1e-5, 0.0 }, 2000);
    lead(a, { -1e-5, 0.0 }, 2000);
    const double degree = std::acos(-1.0) / 180.0;
    turn(a, 1e-3 * degree, 100);
    // one end closes by half an edge times the angle
    const double closed = 0.5 * size * 1e-3 * degree;
    CHECK(force_on_first(a).x
        == Approx(-material.normal_stiffness * closed * area / 6.0).epsilon(0.01));
    turn(a, -1e-3 * degree, 100);
    // turned by less than 30 degrees, the face meets with its end
    const double first = size * std::tan(10.0 * degree);  // across the mean of both faces
    lead(a, { 0.6 * size, 0.0 }, 1000);
    turn(a, 20.0 * degree, 1000);
    lead(a, { first + press - 0.6 * size, 0.0 }, 1000);
    CHECK(norm(force_on_first(a)) == 0.0);
    lead(a, { -2.0 * press, 0.0 }, 100);
    CHECK(norm(force_on_first(a)) == Approx(pressing / 6.0).epsilon(0.1));
    // beyond that it is no face any more, and the discs are smaller
    lead(a, { 0.5 * size, 0.0 }, 1000);
    turn(a, 41.0 * degree, 1000);
    lead(a, { -0.5 * size, 0.0 }, 1000);
    CHECK(norm(force_on_first(a)) == 0.0);
}

TEST_CASE("A grain that has gone round to the other side does not meet the back of a face")
{
    Assembly a = held_pair(GENERATE(false, true), 0.87);
    lead(a, { 1e-5, 0.0 }, 2000);
    lead(a, { 0.5 * size, 0.0 }, 100);
    lead(a, { 0.0, 2.0 * size }, 400);
    lead(a, { -2.5 * size, 0.0 }, 400);
    lead(a, { 0.0, -2.0 * size }, 400);
    CHECK(active_contacts(a) == 0);
    lead(a, { -0.1 * size, 0.0 }, 100);
    CHECK(norm(force_on_first(a)) == 0.0);
}

TEST_CASE("A crack that bears nothing once its faces have parted goes over to the discs' touch")
{
    const bool rigid = GENERATE(false, true);
    Assembly a = held_pair(rigid, 1.0);
    lead(a, { 1e-5, 0.0 }, 2000);
    lead(a, { -2e-5, 0.0 }, 2000);  // the discs overlap
    turn(a, 1.3, 2000);
    REQUIRE(flexpm::parting(flexpm::bond_faces(a, 0)) == 1.0);
    CHECK(a.contacts.bonded[0] == 1);
    CHECK(active_contacts(a) == 1);
    for (int p = 0; p < a.contacts.points_of(0); ++p) {
        a.contacts.state(0, p, &flexpm::PointState::opening) = 1e-4;
        a.contacts.state(0, p, &flexpm::PointState::shear_traction) = 0.0;
    }
    lead(a, {}, 20);
    REQUIRE(a.contacts.count == 2);
    CHECK_FALSE(flexpm::is_active(a.contacts, 0));
    CHECK(flexpm::is_active(a.contacts, 1));
    CHECK(a.contacts.bonded[1] == 0);
    CHECK(norm(force_on_first(a)) == 0.0);
    lead(a, press * flexpm::Point { -1.0, 0.0 }, 100);
    CHECK(norm(force_on_first(a)) > 0.1 * pressing);
}

TEST_CASE("A pair that parts, slides and meets again makes no energy")
{
    const bool rigid = GENERATE(false, true);
    const double disc = GENERATE(0.87, 1.1);
    Assembly a = held_pair(rigid, disc);
    lead(a, { 1e-5, 0.0 }, 2000);
    flexpm::reset_energy_balance(a);
    double friction = 0.0;
    const auto look = [&] {
        const flexpm::Energies e = flexpm::energies(a);
        CAPTURE(rigid, disc, e.elastic, e.friction, e.damage, e.kinetic, e.boundary_work, e.initial,
            e.damping);
        CHECK(e.friction >= friction - 1e-9);
        friction = e.friction;
        CHECK(balance::miss(e) == Approx(0.0).margin(2e-3 * (e.friction + e.elastic) + 1e-9));
    };
    lead(a, { -1e-5 - 5.0 * press, 0.0 }, 4000);
    const double pressed = -5.0 * press / size;
    for (Point way : { Point { 0.0, 0.3 }, Point { 0.0, -0.6 }, Point { 0.0, 0.6 },
             Point { 0.0, 0.5 }, Point { 0.7, 0.0 }, Point { 0.0, -0.8 }, Point { -0.7, 0.0 },
             Point { pressed, 0.0 }, Point { 0.0, 0.4 } }) {
        lead(a, size * way, 4000);
        look();
    }
    CHECK(norm(force_on_first(a)) > pressing);
}

TEST_CASE("Forces of a crack that has met again are in balance, moments included")
{
    const bool rigid = GENERATE(false, true);
    Assembly a = held_pair(rigid, 0.87);
    lead(a, { 1e-5, 0.0 }, 2000);
    lead(a, { 0.6 * size, 0.0 }, 1000);
    lead(a, { -0.6 * size - 1e-5 - press, 0.0 }, 10000);
    lead(a, { 0.0, 0.3 * size }, 1000);
    const int c = 0;
    REQUIRE(flexpm::is_active(a.contacts, c));
    Point sum;
    double moment = 0.0;
    for (int side = 0; side < 2; ++side) {
        for (int end = 0; end < 2; ++end) {
            const Point force = contact_force(a, c, side, end);
            sum = sum + force;
            moment += cross(a.grains.point_at(a.contacts.node(c, side, end)), force);
        }
    }
    REQUIRE(norm(force_on_first(a)) > 0.5 * pressing);
    CHECK(norm(sum) < 1e-12 * pressing);
    CHECK(std::fabs(moment) < 1e-6 * pressing * size);
}

TEST_CASE("A step of a crack between its faces agrees with a plain one", "[reference]")
{
    const bool rigid = GENERATE(false, true);
    Assembly a = held_pair(rigid, 0.87);
    lead(a, { 1e-5, 0.0 }, 2000);
    lead(a, { -1e-5 - press, 0.0 }, 2000);
    flexpm::StepOptions options;
    options.damping = 0.0;
    plain::Differences all;
    set_velocity(a, 1, [](Point p) { return Point { -1e-6 * p.y, 1e-6 + 1e-6 * p.x }; });
    if (rigid) a.grains.spin[a.grains.slot[1]] = 1e-6;
    for (int i = 0; i < 100; ++i) {
        contact_round::update_contacts(a);
        plain::Specimen expected = plain::read_state(a);
        const plain::Specimen before = expected;
        plain::step(expected, options.dt, options.damping);
        flexpm::step(a, options);
        all.take_larger(plain::compare(before, plain::read_state(a), expected));
    }
    CAPTURE(all.text());
    CHECK(all.largest() < 1e-12);
    CHECK(all.records == 0);
}

TEST_CASE("Overlaps of grains are those of their polygons, faces and corners apart")
{
    Assembly a = held_pair(false, 0.87);
    CHECK(flexpm::find_overlaps(a, 1e-6).empty());
    set_velocity(a, 1, Point { -0.1 * size, 0.2 * size });
    run(a, 1);
    const auto found = flexpm::find_overlaps(a, 1e-3);
    REQUIRE(found.size() == 1);
    CHECK(found[0].pair == GrainPair { 0, 1 });
    CHECK(found[0].area == Approx(0.08 * size * size));
    CHECK(found[0].part == Approx(0.08));
    CHECK(found[0].bonded);
    CHECK(found[0].facing);
    CHECK(flexpm::find_overlaps(a, 0.09).empty());
    run(a, 2);
    CHECK_FALSE(flexpm::find_overlaps(a, 1e-3)[0].facing);  // slid by more than half an edge
}
