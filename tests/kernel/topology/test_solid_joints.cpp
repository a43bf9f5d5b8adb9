// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Contacts of polyhedral grains that lie on joints have the law of their joint.
#include "support/catch.hpp"

#include "support/solid_states.hpp"

#include <stdexcept>

using namespace solid_states;

TEST_CASE("Contacts on joints have the laws of their joints, and are cracked without strength",
    "[solids]")
{
    const Packing p = packing(60, 6);
    SolidInput input = granite();
    ContactMaterial open = input.contacts[0], bonded = open;
    open.cohesion = open.tensile_strength = 0.0;
    bonded.cohesion *= 0.5;
    input.joints = { open, bonded };
    for (int contact = 0; contact < p.cells.contacts; ++contact)
        input.joint.push_back(contact % 3 - 1);
    const SolidState s = make_solid(p.cells, p.solid, input);
    REQUIRE(s.contacts.joint == input.joint);
    const LawParameters laws[] = { make_law(input.contacts[0]), joint_law(open),
        joint_law(bonded) };
    for (int contact = 0; contact < s.contacts.count; ++contact) {
        const int joint = input.joint[contact];
        CHECK(s.contacts.law_of(contact).cohesion == laws[joint + 1].cohesion);
        for (int point = 0; point < s.contacts.points_of(contact); ++point) {
            const double damage = s.contacts.state(contact, point, FaceRow::shear_damage);
            CHECK(damage == (joint == 0 ? 1.0 : 0.0));
            CHECK(s.contacts.crack(contact, point).mode == intact);
        }
    }
    // factors act on joints, too
    input.strength.assign(p.cells.contacts, 0.5);
    const SolidState weak = make_solid(p.cells, p.solid, input);
    CHECK(weak.contacts.law_of(2).cohesion == joint_law(scaled_strength(bonded, 0.5)).cohesion);
    input.joint.back() = 2;
    CHECK_THROWS_WITH(
        make_solid(p.cells, p.solid, input), Catch::Contains("must be the index of a joint"));
    input.joint.pop_back();
    CHECK_THROWS_AS(make_solid(p.cells, p.solid, input), std::invalid_argument);
}
