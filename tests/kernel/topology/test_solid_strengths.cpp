// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Contacts of polyhedral grains whose strengths have factors of their own.
#include "support/catch.hpp"

#include "support/solid_states.hpp"

#include <stdexcept>

using namespace solid_states;

TEST_CASE("Each contact of a solid has the law with its factor, at the stiffness of the others",
    "[solids]")
{
    const Packing p = packing(60, 6);
    for (const bool rigid : { false, true }) {
        SolidInput input = granite(FacePointRule::corners_and_inner, rigid);
        for (int contact = 0; contact < p.cells.contacts; ++contact)
            input.strength.push_back(0.5 + 0.01 * contact);
        const SolidState s = make_solid(p.cells, p.solid, input);
        for (int contact = 0; contact < p.cells.contacts; ++contact) {
            const LawParameters expected =
                make_law(scaled_strength(input.contacts[0], input.strength[contact]));
            CHECK(s.contacts.law_of(contact).tensile_strength == expected.tensile_strength);
            CHECK(s.contacts.law_of(contact).cohesion == expected.cohesion);
            CHECK(s.contacts.law_of(contact).normal_stiffness == expected.normal_stiffness);
        }
        input.strength.pop_back();
        CHECK_THROWS_AS(make_solid(p.cells, p.solid, input), std::invalid_argument);
    }
}
