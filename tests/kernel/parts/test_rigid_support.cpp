// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Supports that resist what is driven, and those that let the specimen follow it.
#include "support/catch.hpp"

#include <flexpm/kernel/parts/rigid_support.hpp>

using namespace flexpm;

namespace {

constexpr Vector x { 1.0, 0.0, 0.0 }, y { 0.0, 1.0, 0.0 }, z { 0.0, 0.0, 1.0 };
constexpr double half = 0.02, stiff = 1e9;

/// A body between -half and half, pressed down in the middle of its top.
RigidSupport pressed(Vector place = { 0.0, half, 0.0 }, Vector along = y)
{
    RigidSupport support({}, 4.0 * half);
    support.add(place, along, stiff, -1.0);
    return support;
}

void refused(const RigidSupport& support, const char* motion)
{
    CHECK_THROWS_WITH(support.require_resistance(), Catch::Contains(motion));
}

}  // namespace

TEST_CASE("A body that nothing holds against its loading moves along with it")
{
    refused(pressed(), "the specimen moves along y with the driven parts");
    refused(pressed({ half, 0.0, 0.0 }, x), "moves along x");
    RigidSupport guided = pressed({ 0.0, 0.0, half }, z);
    for (const double side : { -half, half })
        guided.add({ side, side, side }, x, stiff, 0.0);
    refused(guided, "moves along z");
}

TEST_CASE("A body between two supports out of line turns, and between three rests")
{
    // round-off of the offset is far above that of the energy: half a micrometre turns it
    for (const double aside : { 0.5e-6, 0.1 * half, -half }) {
        RigidSupport support = pressed();
        support.add({ aside, -half, 0.0 }, y, stiff, 0.0);
        refused(support, "rotates about z");
        support.add({ -0.5 * half, -half, 0.0 }, y, stiff, 0.0);
        CHECK_NOTHROW(support.require_resistance());
    }
    RigidSupport in_space = pressed({ 0.0, 0.0, half }, z);
    in_space.add({ 0.0, 1e-3, -half }, z, stiff, 0.0);
    refused(in_space, "rotates about x");
}

TEST_CASE("Supports in line with the loading resist, however soft they are")
{
    for (const double stiffness : { 1e-6 * stiff, stiff, 1e6 * stiff }) {
        RigidSupport support = pressed();
        support.add({ 0.0, -half, 0.0 }, y, stiffness, 0.0);
        CHECK_NOTHROW(support.require_resistance());
    }
}

TEST_CASE("A rotation is resisted by another one, also of sets that are free to move")
{
    for (const bool floats : { false, true }) {
        const auto turned = [&](RigidSupport& support, double middle, double angle) {
            for (const double side : { -1e-3, 1e-3 }) {
                const Vector arm { side, 0.0, 0.0 };
                if (floats)
                    support.add_turning(arm, y, stiff, angle * side);
                else
                    support.add(Vector { middle, 0.0, 0.0 } + arm, y, stiff, angle * side);
            }
        };
        RigidSupport support({}, 4.0 * half);
        turned(support, half, 1.0);
        refused(support, "rotates about z");
        turned(support, -half, -1.0);
        CHECK_NOTHROW(support.require_resistance());
    }
}
