// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The push between two discs, paper Sec. 3.1.
#include <flexpm/kernel/geometry/disc_repulsion.hpp>

#include "support/catch.hpp"

using flexpm::DiscPair;
using flexpm::push_apart;

TEST_CASE("Touching discs are pushed apart along their centres, in proportion to the overlap")
{
    const DiscPair pair = { 1.25, 0.5, true };
    const auto step = push_apart(pair, { 2.0, -1.0, 3.0 }, { 2.6, -0.2, 3.0 });
    CHECK_FALSE(step.changes);
    CHECK(step.push.x == Approx(0.5 * 0.25 * 0.6));
    CHECK(step.push.y == Approx(0.5 * 0.25 * 0.8));
}

TEST_CASE("A pair tells when it begins and ceases to touch")
{
    const double distance = GENERATE(0.5, 1.2499999, 1.2500001, 2.0);
    const bool apart = distance > 1.25;
    CHECK(
        push_apart({ 1.25, 0.5, true }, { 0.0, 0.0, 0.0 }, { 0.0, 0.6 * distance, 0.8 * distance })
            .changes
        == apart);
    CHECK(
        push_apart({ 1.25, 0.5, false }, { 0.0, 0.0, 0.0 }, { 0.0, 0.6 * distance, 0.8 * distance })
            .changes
        == !apart);
}
