// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Faces of joints that slide far and are paired anew. SI units, tension positive.
#include "support/catch.hpp"

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/topology/erasure.hpp>

#include "support/balance.hpp"
#include "support/driven.hpp"
#include "support/joint_rows.hpp"

#include <limits>
#include <tuple>

using namespace driven;
using namespace joint_rows;
using flexpm::GrainPair;

namespace {

/// Sums over the contacts of the joint.
struct Sums {
    double area = 0.0;  ///< [m^2]
    Point force;        ///< on the lower row [N]
    int count = 0;
};

Sums sums_of(const Assembly& a)
{
    Sums sums;
    for (int c = 0; c < a.contacts.count; ++c) {
        if (a.contacts.joint[c] < 0 || !flexpm::is_active(a.contacts, c)) continue;
        for (int p = 0; p < a.contacts.points_of(c); ++p)
            sums.area += a.contacts.area(c, p);
        sums.force = sums.force + resultant(a, c);
        ++sums.count;
    }
    return sums;
}

/// Area of the present contacts of a pair, as a part of a whole face.
double part_of_face(const Assembly& a, GrainPair pair)
{
    double area = 0.0;
    for (int c = 0; c < a.contacts.count; ++c) {
        if (a.contacts.pairs[c] != pair) continue;
        for (int p = 0; p < a.contacts.points_of(c); ++p)
            area += a.contacts.area(c, p);
    }
    return area / (size * specimens::thickness);
}

constexpr double press = -1e-7;  // [m]: 1 MPa
const double pressure = -smooth_joint().normal_stiffness * press;

}  // namespace

TEST_CASE("Faces that slide get the partners that lie opposite to them")
{
    Assembly a = held_rows();
    CHECK(flexpm::follow_faces(a, 0.7, 1.0).empty());
    move_row(a, { 0.3 * size, 0.0 }, 300);
    for (int i = 0; i < columns; ++i) {
        CHECK(part_of_face(a, { i, i + columns }) == Approx(0.7).margin(0.06));
        if (i > 0) CHECK(part_of_face(a, { i, i - 1 + columns }) == Approx(0.3).margin(0.06));
    }
    CHECK(sums_of(a).count == 2 * columns - 1);
    move_row(a, { 1.0 * size, 0.0 }, 1000);
    CHECK(part_of_face(a, { 3, 3 + columns }) == 0.0);
    CHECK(part_of_face(a, { 3, 2 + columns }) == Approx(0.7).margin(0.06));
    CHECK(part_of_face(a, { 3, 1 + columns }) == Approx(0.3).margin(0.06));
    CHECK(sums_of(a).count == 2 * (columns - 1) - 1);
}

TEST_CASE("Area and tractions of a joint stay right over a slip of three grains")
{
    const auto [rigid, points] = GENERATE(std::make_tuple(false, 3), std::make_tuple(true, 3),
        std::make_tuple(true, 2), std::make_tuple(true, 1));
    Assembly a = held_rows(rigid, points);
    move_row(a, { 0.0, press }, 100);
    double slip = 0.0;
    for (int i = 0; i < 32; ++i) {
        move_row(a, { 0.1 * size, 0.0 }, 100);
        slip += 0.1 * size;
        const Sums now = sums_of(a);
        const double area = (columns * size - slip) * specimens::thickness;
        CHECK(now.area == Approx(area).epsilon(0.01));
        CHECK(now.force.y == Approx(-pressure * now.area).epsilon(1e-6));
        CHECK(now.force.x == Approx(friction * pressure * now.area).epsilon(1e-6));
    }
}

TEST_CASE("Faces that slide back find their first partners")
{
    Assembly a = held_rows();
    move_row(a, { 0.0, press }, 100);
    move_row(a, { 2.6 * size, 0.0 }, 1000);
    move_row(a, { -2.6 * size, 0.0 }, 1000);
    const Sums back = sums_of(a);
    CHECK(back.area == Approx(columns * size * specimens::thickness).epsilon(0.01));
    CHECK(back.force.x == Approx(-friction * pressure * back.area).epsilon(1e-6));
    for (int i = 0; i < columns; ++i)
        CHECK(part_of_face(a, { i, i + columns }) == Approx(1.0).margin(0.06));
}

TEST_CASE("Faces that have slid off each other meet again when they come back")
{
    Assembly a = held_rows();
    move_row(a, { (columns + 1) * size, 0.0 }, 2000);
    CHECK(sums_of(a).count == 0);
    move_row(a, { -(columns + 1) * size, 0.0 }, 2000);
    CHECK(sums_of(a).area == Approx(columns * size * specimens::thickness).epsilon(0.01));
}

TEST_CASE("The energy that new partners change is booked as friction")
{
    const bool rigid = GENERATE(false, true);
    auto joint = smooth_joint();
    joint.dilation = 0.1;
    joint.dilation_slip = 0.5 * size;
    Assembly a = held_rows(rigid, 3, joint);
    flexpm::reset_energy_balance(a);
    move_row(a, { 0.0, 50.0 * press }, 1000);
    move_row(a, { 1.7 * size, 0.0 }, 20000);
    const flexpm::Energies e = flexpm::energies(a);
    CHECK(e.friction > 0.0);
    CHECK(balance::miss(e) == Approx(0.0).margin(1e-4 * e.friction));
}

TEST_CASE("A joint dilates by its whole slip, whatever partners its faces have had")
{
    auto joint = smooth_joint();
    joint.dilation = 0.1;
    joint.dilation_slip = 0.5 * size;
    Assembly a = held_rows(true, 3, joint);
    // led along its dilation: the pressure stays
    move_row(a, { 0.0, press }, 100);
    move_row(a, { 0.5 * size, 0.05 * size }, 2000);
    move_row(a, { 0.5 * size, 0.0 }, 1000);
    const Sums now = sums_of(a);
    CHECK(now.force.y == Approx(-pressure * now.area).epsilon(0.05));
}

TEST_CASE("The friction of a joint falls with its whole slip, whatever partners its faces have had")
{
    const bool rigid = GENERATE(false, true);
    auto joint = smooth_joint();
    joint.residual_friction = 0.3;
    joint.slip_length = 1.5 * size;
    Assembly a = held_rows(rigid, 3, joint);
    flexpm::reset_energy_balance(a);
    move_row(a, { 0.0, press }, 100);
    for (int i = 1; i <= 20; ++i) {
        move_row(a, { 0.1 * size, 0.0 }, 200);
        const Sums now = sums_of(a);
        const double fallen = std::min(i / 15.0, 1.0) * (joint.friction - joint.residual_friction);
        CHECK(now.force.x / -now.force.y == Approx(joint.friction - fallen).epsilon(1e-3));
    }
    const flexpm::Energies e = flexpm::energies(a);
    CHECK(balance::miss(e) == Approx(0.0).margin(1e-3 * e.friction));
}

TEST_CASE("Faces that have not cracked keep their partners")
{
    auto joint = smooth_joint();
    joint.cohesion = joint.tensile_strength = 1e12;
    joint.tensile_fracture_energy = joint.shear_fracture_energy = 1e13;
    Assembly a = held_rows(false, 3, joint);
    move_row(a, { 0.3 * size, 0.0 }, 300);
    CHECK(sums_of(a).count == columns);
    CHECK(part_of_face(a, { 3, 3 + columns }) == Approx(1.0));
}

namespace {

int contact_of(const Assembly& a, GrainPair pair)
{
    int found = 0;
    while (a.contacts.pairs[found] != pair)
        ++found;
    return found;
}

void set_damage(Assembly& a, int contact, double damage)
{
    for (int p = 0; p < a.contacts.points_of(contact); ++p) {
        a.contacts.state(contact, p, &flexpm::PointState::shear_damage) = damage;
        a.contacts.state(contact, p, &flexpm::PointState::max_opening) = 0.0;
    }
}

/// Move the upper row by a part of a square in one step.
void jump(Assembly& a, double part)
{
    for (int g = columns; g < 2 * columns; ++g)
        set_velocity(a, g, Point { part * size, 0.0 });
    run(a, 1);
}

}  // namespace

TEST_CASE("Masses rise for new partners, real ones stay")
{
    const double dt = GENERATE(0.0, 1.0);
    Assembly a = two_rows(true);
    flexpm::scale_masses(a, 0.7);
    a.contacts.laws[0].normal_stiffness *= 2.0;  // of the bonds: masses have to be larger now
    const auto before = a.grains.inverse_mass;
    jump(a, 0.1);
    CHECK_FALSE(flexpm::follow_faces(a, 0.7, dt).empty());
    CHECK((a.grains.inverse_mass == before) == (dt == 0.0));
}

TEST_CASE("Only the cracked faces of a joint that has cracked in part get new partners")
{
    Assembly a = held_rows();
    const int beside = contact_of(a, { 0, 1 }), bond = contact_of(a, { 7, 7 + columns });
    a.contacts.joint[beside] = 0;  // the joint turns down beside the first grain
    set_damage(a, beside, 1.0);
    a.contacts.law[bond] = 0;
    jump(a, 0.3);
    set_damage(a, bond, 0.0);
    flexpm::follow_faces(a, 0.7, 1.0);
    CHECK(part_of_face(a, { 7, 7 + columns }) == Approx(1.0));
    CHECK(part_of_face(a, { 7, 6 + columns }) == 0.0);
    CHECK(part_of_face(a, { 4, 3 + columns }) == Approx(0.3));
    CHECK(part_of_face(a, { 0, 1 }) == Approx(1.0));
}

TEST_CASE("Faces that are nowhere have no partners")
{
    Assembly a = held_rows();
    const double nowhere = std::numeric_limits<double>::quiet_NaN();
    jump(a, 0.3);
    const int first = contact_of(a, { 0, columns }), second = contact_of(a, { 1, 1 + columns });
    for (int node : { a.contacts.node(first, 0, 0), a.contacts.node(second, 0, 1) })
        flexpm::set_vector(a.grains.displacement, node, { nowhere, nowhere });
    flexpm::follow_faces(a, 0.7, 0.0);
    CHECK(part_of_face(a, { 4, 3 + columns }) == Approx(0.3));
    CHECK(part_of_face(a, { 1, columns }) == 0.0);
    std::fill(a.grains.displacement.begin(), a.grains.displacement.end(), nowhere);
    flexpm::follow_faces(a, 0.7, 0.0);
    CHECK(part_of_face(a, { 4, 3 + columns }) == 0.0);
}

TEST_CASE("What a script erases gets no new partner")
{
    Assembly a = held_rows();
    flexpm::Erasure what;
    what.contacts = { contact_of(a, { 3, 3 + columns }) };
    what.grains = { 5 };
    flexpm::erase(a, what, 1.0);
    move_row(a, { 0.5 * size, 0.0 }, 500);
    for (int other : { 2, 3 })
        CHECK(part_of_face(a, { 3, other + columns }) == 0.0);
    CHECK(part_of_face(a, { 5, 4 + columns }) == 0.0);
    CHECK(part_of_face(a, { 6, 5 + columns })
        == 0.0);  // a face of the erased grain's partner went with it
    CHECK(part_of_face(a, { 8, 7 + columns }) == Approx(0.5).margin(0.06));
}

TEST_CASE("Forces between faces that have slid are in balance, moments included")
{
    Assembly a = held_rows();
    move_row(a, { 0.0, press }, 100);
    move_row(a, { 0.37 * size, 0.0 }, 500);
    for (int c = 0; c < a.contacts.count; ++c) {
        if (a.contacts.joint[c] < 0) continue;
        Point sum;
        double moment = 0.0;
        for (int side = 0; side < 2; ++side) {
            for (int end = 0; end < 2; ++end) {
                const Point force = contact_force(a, c, side, end);
                sum = sum + force;
                moment += cross(a.grains.point_at(a.contacts.node(c, side, end)), force);
            }
        }
        const double scale = pressure * size * specimens::thickness;
        CHECK(norm(sum) < 1e-12 * scale);
        CHECK(std::fabs(moment) < 1e-9 * scale * size);
    }
}
