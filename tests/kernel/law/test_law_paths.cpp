// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The bilinear law on random mixed-mode paths: envelope, damage, energy; and its brittle
/// limit against Mohr-Coulomb with a tension cut-off. Tension positive.
#include "support/catch.hpp"

#include "support/law_path.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <vector>

using namespace law_path;

namespace {

struct Leg {
    double opening, slip;  ///< steps [m]
};

/// Legs of random direction and length: some elastic, some well into softening, some far beyond.
std::vector<Leg> random_legs(const ContactMaterial& m, flexpm::Random& random, int count)
{
    std::vector<Leg> legs;
    double opening = 0.0;
    const double ue = elastic_opening(m), se = elastic_slip(m);
    for (int i = 0; i < count; ++i) {
        const double reach = random.next(), side = random.next() < 0.5 ? -1.0 : 1.0;
        const double target = random.next() < 0.4
            ? -3.0 * ue * random.next()
            : ue * random.next() + (critical_opening(m) - ue) * 0.7 * reach * random.next();
        const double slip = side
            * (1.5 * se * random.next() + (critical_slip(m) - se) * 0.5 * reach * random.next());
        legs.push_back({ target - opening, slip });
        opening = target;
    }
    return legs;
}

/// Envelope and monotony, after every step.
void check_step(const ContactMaterial& m, const PointState& old, const Path& path)
{
    const PointState& s = path.state;
    const Traction& t = path.traction;
    const double strength = (1.0 - t.damage) * m.tensile_strength;
    const double limit = std::max((1.0 - t.damage) * m.cohesion - m.friction * t.normal, 0.0);
    const double slack = 1e-12;
    REQUIRE(t.normal <= strength + slack * m.tensile_strength);
    REQUIRE(std::fabs(t.shear) <= limit * (1.0 + slack) + slack * m.cohesion);
    REQUIRE(t.damage >= t.damage_before);
    REQUIRE(t.damage <= 1.0);
    REQUIRE(s.max_opening >= std::max(old.max_opening, s.opening));
    REQUIRE(s.shear_damage >= old.shear_damage);
    const double round_off = 1e-13 * m.tensile_fracture_energy;
    REQUIRE(s.damage_energy >= old.damage_energy - round_off);
    REQUIRE(s.friction_energy >= old.friction_energy);
    REQUIRE(path.stored() >= 0.0);
}

bool same_bits(const void* a, const void* b, std::size_t size) { return !std::memcmp(a, b, size); }

}  // namespace

TEST_CASE("On any path tractions stay inside the envelope, damage and losses only grow")
{
    flexpm::Random random(11);
    for (int i = 0; i < 400; ++i) {
        const ContactMaterial m = random_material(random);
        const int steps = 1 + static_cast<int>(30 * random.next());
        Path path(m);
        for (const Leg& leg : random_legs(m, random, 8)) {
            for (int k = 0; k < steps; ++k) {
                const PointState old = path.state;
                path.advance(leg.opening / steps, leg.slip / steps);
                check_step(m, old, path);
            }
        }
    }
}

TEST_CASE("The work of a path is stored or dissipated, to first order in the step")
{
    // every error is of the order of one step's overshoot, so halving the step halves the sum
    double error[3] = {}, total = 0.0;
    int cracked = 0;
    for (int refinement = 0; refinement < 3; ++refinement) {
        flexpm::Random random(12);
        for (int i = 0; i < 300; ++i) {
            const ContactMaterial m = random_material(random);
            const int steps = 400 << refinement;
            Path path(m);
            for (const Leg& leg : random_legs(m, random, 6))
                path.advance(leg.opening, leg.slip, steps);
            const double scale = m.tensile_fracture_energy + m.shear_fracture_energy;
            const double miss = path.work - path.stored() - path.dissipated();
            error[refinement] += std::fabs(miss) / scale;
            CHECK(std::fabs(miss) < 0.02 * scale / (1 << refinement));
            if (refinement == 0) total += std::fabs(path.work) / scale;
            if (refinement == 0) cracked += path.cracked();
        }
    }
    CAPTURE(error[0], error[1], error[2], total, cracked);
    CHECK(cracked > 100);
    CHECK(cracked < 290);
    CHECK(error[0] < 1e-3 * total);
    CHECK(error[1] < 0.6 * error[0]);
    CHECK(error[2] < 0.6 * error[1]);
}

TEST_CASE("The short cuts of the elastic branch and of friction give the bits of the whole law")
{
    flexpm::Random random(13);
    int taken = 0, slid = 0, refused = 0, idle_refused = 0;
    for (int i = 0; i < 3000; ++i) {
        ContactMaterial m = random_material(random);
        if (i % 3 == 0) {
            m.dilation = m.friction * random.next();
            m.dilation_slip = critical_slip(m) * random.next();
        }
        const int steps = 1 + static_cast<int>(20 * random.next());
        Path path(m);
        for (const Leg& leg : random_legs(m, random, 8)) {
            for (int k = 0; k < steps; ++k) {
                const PointState old = path.state;
                PointState next;
                Traction traction;
                const bool elastic = flexpm::advance_elastic(
                    path.law, leg.opening / steps, leg.slip / steps, old, next, traction);
                path.advance(leg.opening / steps, leg.slip / steps);
                if (elastic) {
                    ++taken;
                    REQUIRE(same_bits(&next, &path.state, sizeof next));
                    REQUIRE(same_bits(&traction, &path.traction, sizeof traction));
                } else if (old.shear_damage >= 1.0) {
                    ++slid;
                    const flexpm::Sliding slide =
                        flexpm::slide_used_up(path.law, traction.normal, old, next);
                    traction.normal = slide.normal;
                    traction.shear = next.shear_traction = slide.shear;
                    next.friction_energy += slide.loss;
                    REQUIRE(same_bits(&next, &path.state, sizeof next));
                    REQUIRE(same_bits(&traction, &path.traction, sizeof traction));
                } else {
                    ++refused;
                    idle_refused += path.state.damage_energy == old.damage_energy
                        && path.state.friction_energy == old.friction_energy;
                }
            }
        }
    }
    CAPTURE(taken, slid, refused, idle_refused);
    CHECK(taken > 10000);
    CHECK(slid > 10000);
    CHECK(refused > 10000);
}

namespace {

/// Mohr-Coulomb with a tension cut-off, written down on its own: elastic until either strength is
/// exceeded, then dry friction.
struct MohrCoulomb {
    ContactMaterial m;
    double opening = 0.0, normal = 0.0, shear = 0.0;
    bool broken = false, tensile = false;

    void advance(double opening_step, double slip_step)
    {
        opening += opening_step;
        shear += shear_stiffness(m) * slip_step;
        normal = m.normal_stiffness * opening;
        if (!broken) {
            tensile = normal > m.tensile_strength;
            broken = tensile || std::fabs(shear) > std::max(m.cohesion - m.friction * normal, 0.0);
        }
        if (!broken) return;
        normal = std::min(normal, 0.0);
        const double friction = -m.friction * normal;
        shear = std::min(std::max(shear, -friction), friction);
    }
};

}  // namespace

TEST_CASE("With the least fracture energies the law is Mohr-Coulomb with a tension cut-off")
{
    flexpm::Random random(14);
    int broken = 0, tensile = 0;
    for (int i = 0; i < 2000; ++i) {
        const ContactMaterial m = brittle(random_material(random));
        Path path(m);
        MohrCoulomb reference { m };
        const int steps = 1 + static_cast<int>(40 * random.next());
        for (Leg leg : random_legs(m, random, 8)) {
            leg.opening *= i % 3 == 0 ? 1.3 : 0.8;  // above the tensile strength, or always below
            for (int k = 0; k < steps; ++k) {
                path.advance(leg.opening / steps, leg.slip / steps);
                reference.advance(leg.opening / steps, leg.slip / steps);
                REQUIRE(path.cracked() == reference.broken);
                REQUIRE(path.traction.damage == (reference.broken ? 1.0 : 0.0));
                REQUIRE(path.traction.normal
                    == Approx(reference.normal).margin(1e-9 * m.tensile_strength));
                REQUIRE(path.traction.shear == Approx(reference.shear).margin(1e-9 * m.cohesion));
            }
        }
        broken += reference.broken;
        tensile += reference.tensile;
    }
    CAPTURE(broken, tensile);
    CHECK(broken > 500);
    CHECK(tensile > 100);
    CHECK(broken - tensile > 100);
}

TEST_CASE("The brittle limit cracks at the smallest excess and dissipates the elastic energy")
{
    flexpm::Random random(15);
    int tried = 0;
    for (int i = 0; i < 2000; ++i) {
        const ContactMaterial m = brittle(random_material(random));
        Path path(m);
        path.slip_to(0.999999 * elastic_slip(m));
        const double up = 1.0 + (1 + i % 4) * std::numeric_limits<double>::epsilon();
        const double step = (m.cohesion * up - path.traction.shear) / shear_stiffness(m);
        if (path.traction.shear + path.law.shear_stiffness * step <= m.cohesion) continue;
        path.advance(0.0, step);
        ++tried;
        CHECK(path.cracked());
        CHECK(path.traction.shear <= 1e-12 * m.cohesion);
        CHECK(path.state.damage_energy == Approx(m.shear_fracture_energy).epsilon(1e-5));
    }
    CHECK(tried > 1000);
}
