// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The state of a solid lists all that a run continues from, to the same bits.
#include "support/catch.hpp"

#include <flexpm/kernel/laboratory/solid_drive.hpp>
#include <flexpm/kernel/laboratory/solid_ends.hpp>
#include <flexpm/kernel/laboratory/steady_motion.hpp>
#include <flexpm/kernel/statics/solid_field.hpp>

#include "assembly/members.hpp"
#include "support/solid_states.hpp"

using namespace solid_states;
using namespace members;

namespace {

const StepOptions each { 1.0, 0.7, 1, true };

/// Drawn apart so fast that points crack, its mean motion followed.
SolidState torn(bool rigid)
{
    const Packing p = packing(40, 6);
    SolidState s = make_solid(p.cells, p.solid, granite(FacePointRule::corners_and_inner, rigid));
    hold_ends(s, { true, false });
    scale_masses(s, each.damping);
    start_ends(s, elastic_field(s), 1e-4, 2e-6 * p.solid.high.z, true, each.dt);
    for (int k = 0; k < 800; ++k)
        step(s, each);
    REQUIRE(count_cracks(s).tensile > 3);
    for (int look = 0; look < 2; ++look) {
        follow_steady_motion(s, each.dt, 1e-6);
        step(s, each);
    }
    return s;
}

}  // namespace

TEST_CASE("Each saved part of a solid lists all its members", "[solids]")
{
    check_members(Tetrahedra());
    check_members(FaceGroup());
    check_members(FaceCrack());
    check_members(FaceContacts());
    check_members(SurfaceTriangles());
    check_members(RigidBody());
    check_members(HeldFace());
    const SolidState s;
    CHECK(in_order(s));
    CHECK(size_of_members(s) + sizeof(SolidPlan) == sizeof(SolidState));
}

TEST_CASE("A solid saved after any step goes on to the same bits", "[solids]")
{
    for (const bool rigid : { false, true }) {
        SolidState whole = torn(rigid);
        CHECK(same_bits::difference(whole, same_bits::copy_of_members(whole)).empty());
        for (int k = 0; k < 3; ++k) {
            SolidState loaded = same_bits::copy_of_members(whole);
            prepare_step(loaded);
            for (int i = 0; i < 20; ++i) {
                step(loaded, { each.dt, each.damping, 2, true });
                step(whole, each);
            }
            for (SolidState* s : { &loaded, &whole }) {
                const SolidDrive top = drive_of_top(*s);
                go_on(*s, top, 0.9 * velocity_of(*s, top), each.dt);
            }
            CAPTURE(rigid, k);
            CHECK(same_bits::difference(whole, loaded).empty());
        }
        // what is left out is seen
        SolidState other = same_bits::copy_of_members(whole);
        const double old = other.contacts.state(0, 0, FaceRow::max_opening);
        other.contacts.set_state(0, 0, FaceRow::max_opening, old + 1e-12);
        CHECK(same_bits::difference(whole, other).rfind("contacts.states.", 0) == 0);
    }
}
