// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Friction springs of a pair against Coulomb's law and their energies.
#include "support/catch.hpp"

#include <flexpm/kernel/core/random.hpp>
#include <flexpm/kernel/pairs/pair_friction.hpp>

using namespace flexpm;

namespace {

constexpr double k_s = 2e13, mu = 0.4, area = 2e-6, pressing = 100.0;
const PairPress flat { { 0.0, 0.0, 1.0 }, pressing, area };

double stored(const PairContact& pair) { return spring_energy(pair, k_s); }

}  // namespace

TEST_CASE("A pair sticks with K_s A, and slides at mu N", "[pairs]")
{
    PairContact pair;
    PairFriction f = advance_friction(pair, flat, {}, k_s, mu);
    CHECK(norm(f.force) == 0.0);
    const double limit = mu * pressing / (k_s * area);
    f = advance_friction(pair, flat, { { 0.5 * limit, 0.0, 1.0 }, 0.0 }, k_s, mu);
    CHECK(f.force.x == Approx(0.5 * mu * pressing).epsilon(1e-12));
    CHECK(f.force.z == 0.0);
    CHECK(pair.friction_energy == 0.0);
    for (int k = 0; k < 100; ++k)
        f = advance_friction(pair, flat, { { 0.03 * limit, 0.04 * limit, 0.0 }, 0.0 }, k_s, mu);
    CHECK(norm(f.force) == Approx(mu * pressing).epsilon(1e-12));
    CHECK(f.force.y / f.force.x == Approx(4.0 / 3.0).epsilon(0.05));
    // work of the springs on the way: stored, and what friction has taken
    CHECK(pair.friction_energy > 0.0);
    CHECK(stored(pair) == Approx(0.5 * mu * pressing * limit).epsilon(1e-12));
}

TEST_CASE("A pair that twists bears the moment of a disc that slips about its axis", "[pairs]")
{
    PairContact pair;
    advance_friction(pair, flat, {}, k_s, mu);
    PairFriction f;
    for (int k = 0; k < 100; ++k)
        f = advance_friction(pair, flat, { {}, 1e-3 }, k_s, mu);
    const double radius = std::sqrt(area / pi);
    CHECK(f.moment == Approx(2.0 / 3.0 * mu * pressing * radius).epsilon(1e-12));
    CHECK(norm(f.force) == 0.0);
}

TEST_CASE("Work on the springs is what they store and dissipate", "[pairs]")
{
    Random random(3);
    const auto draw = [&] { return random.next() - 0.5; };
    for (int round = 0; round < 20; ++round) {
        PairContact pair;
        advance_friction(pair, flat, {}, k_s, mu);
        double work = 0.0;
        Vector force;
        for (int k = 0; k < 200; ++k) {
            const double x = draw(), y = draw();
            const PairWay way { { 1e-7 * x, 1e-7 * y, 0.0 }, 0.0 };
            const double dissipated = pair.friction_energy;
            const PairFriction f = advance_friction(pair, flat, way, k_s, mu);
            work += 0.5 * dot(force + f.force, way.slip);
            force = f.force;
            CHECK(pair.friction_energy >= dissipated);
        }
        CHECK(work == Approx(stored(pair) + pair.friction_energy).epsilon(1e-9));
    }
}

TEST_CASE("No energy appears where the pressed area, the pressure or the normal change", "[pairs]")
{
    Random random(5);
    const auto draw = [&] { return random.next(); };
    for (int round = 0; round < 200; ++round) {
        PairContact pair;
        advance_friction(pair, flat, { { 5e-7 * draw(), 0.0, 0.0 }, 1e-4 * draw() }, k_s, mu);
        const double before = stored(pair) + pair.friction_energy;
        PairPress other = flat;
        const double tilt = 0.1 * draw();
        other.normal = { std::sin(tilt), 0.0, std::cos(tilt) };
        other.force *= 2.0 * draw();
        other.area *= 0.1 + 2.0 * draw();
        advance_friction(pair, other, {}, k_s, mu);
        CHECK(stored(pair) <= before * (1.0 + 1e-12));
        // all that is stored less has been dissipated, but for the limit's mean of both forces
        CHECK(stored(pair) + pair.friction_energy == Approx(before).epsilon(1e-9));
        CHECK(std::fabs(dot(pair.slip, other.normal)) < 1e-12 * norm(pair.slip));
        const double left = stored(pair) + pair.friction_energy;
        release_friction(pair, k_s);
        CHECK(pair.friction_energy == Approx(left).epsilon(1e-12));
        CHECK(stored(pair) == 0.0);
    }
}
