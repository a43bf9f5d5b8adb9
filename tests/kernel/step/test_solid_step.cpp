// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The step of specimens in space against the plain one, which shares no lanes, lists or
/// plan with it.
#include "support/catch.hpp"

#include "support/solid_states.hpp"

using namespace solid_states;

namespace {

/// What a case does to a random packing.
struct Case {
    const char* name;
    int grains;
    double speed;  ///< of grains that fly apart [m/s]
    double spin;   ///< [rad/s]
    int steps;
    FacePointRule rule;
    double damping;
    bool held;           ///< the ends are held
    bool rigid = false;  ///< grains do not deform
};

/// Steps of a real mass and time.
constexpr double dt = 2e-8;

/// Nodes of both ends are held along z, as a test would; of rigid grains the spin of the first.
void hold_ends(plain_solid::Specimen& plain, double top)
{
    plain.grains.front().spin_held = plain.grains.front().is_rigid();
    for (auto& n : plain.nodes) {
        const bool low = n.reference.z<1e-9, high = n.reference.z> top - 1e-9;
        if (!low && !high) continue;
        n.held[2] = true;
        n.velocity.z = high ? -5.0 : 0.0;
    }
}

/// Largest difference of the states of all points, each relative to a scale of its kind. Openings
/// within the elastic branch are not kept.
double difference_of_points(const SolidState& s, const plain_solid::Specimen& plain)
{
    double worst = 0.0;
    for (std::size_t i = 0; i < plain.contacts.size(); ++i) {
        const int contact = static_cast<int>(i);
        const LawParameters& law = s.contacts.law_of(contact);
        // the corners may begin at another one, and their points with them
        for (const auto& p : plain.contacts[i].points) {
            double least = 1e300;
            const std::vector<FacePlace> places = places_of(s, contact);
            for (int q = 0; q < s.contacts.points_of(contact); ++q) {
                const FacePlace at = places[q];
                const FacePointState state = s.contacts.point_state(contact, q);
                const double energy =
                    law.tensile_strength * law.critical_opening + law.cohesion * law.critical_slip;
                const double far =
                    std::max({ std::fabs(at.opening - p.at.opening) / law.critical_opening,
                        norm(at.slip - p.at.slip) / law.critical_slip,
                        norm(state.plastic_slip - p.state.plastic_slip) / law.critical_slip,
                        std::fabs(std::max(state.max_opening, law.elastic_opening)
                            - std::max(p.state.max_opening, law.elastic_opening))
                            / law.critical_opening,
                        std::fabs(state.shear_damage - p.state.shear_damage),
                        std::fabs(state.damage_energy - p.state.damage_energy) / energy,
                        std::fabs(state.friction_energy - p.state.friction_energy) / energy,
                        std::fabs(s.contacts.area(contact, q) - p.area) / p.area });
                least = std::min(least, far);
            }
            worst = std::max(worst, least);
        }
    }
    return worst;
}

}  // namespace

TEST_CASE("A step in space is that of the plain stepper to round-off", "[solids]")
{
    const auto inner = FacePointRule::corners_and_inner;
    const Case cases[] = {
        { "elastic", 17, 0.02, 10.0, 60, inner, 0.0, false },
        { "damped", 18, 0.02, 10.0, 60, inner, 0.7, false },
        { "softening", 19, 2.0, 1000.0, 60, inner, 0.0, false },
        { "cracked and slid", 20, 20.0, 10000.0, 400, inner, 0.0, false },
        { "cracked, damped and held", 21, 20.0, 10000.0, 400, inner, 0.7, true },
        { "corners", 22, 20.0, 10000.0, 100, FacePointRule::corners, 0.3, false },
        { "three points", 23, 20.0, 10000.0, 100, FacePointRule::three, 0.3, true },
        { "one point", 24, 20.0, 10000.0, 100, FacePointRule::one, 0.3, true },
        { "two tiles", tile_grains + 3, 20.0, 10000.0, 30, inner, 0.3, true },
        { "rigid and elastic", 20, 0.02, 10.0, 60, inner, 0.0, false, true },
        { "rigid, cracked and slid", 20, 20.0, 10000.0, 400, inner, 0.0, false, true },
        { "rigid, damped and held", 21, 20.0, 10000.0, 100, inner, 0.7, true, true },
        { "rigid, two tiles", tile_grains + 3, 20.0, 10000.0, 30, inner, 0.3, true, true },
    };
    std::uint64_t seed = 0;
    for (const Case& c : cases) {
        ++seed;
        const Packing p = packing(c.grains, seed);
        plain_solid::Specimen plain = plain_solid::make_specimen(p.cells, specimens::granite(),
            specimens::granite_contact(), { c.rigid, false, c.rule });
        solid_samples::kick(plain, c.speed, c.spin, seed + 40);
        if (c.held) hold_ends(plain, p.solid.high.z);
        SolidState s = make_solid(p.cells, p.solid, granite(c.rule, c.rigid));
        copy_motion(s, plain);
        plain_solid::Energies expected;
        for (int k = 0; k < c.steps; ++k) {
            expected = plain_solid::step(plain, dt, c.damping);
            step(s, { dt, c.damping, 1, true });
        }
        CAPTURE(c.name);
        CHECK(difference(s, plain, s.grains.displacement, [](const auto& n) {
            return n.displacement;
        }) < 1e-9);
        CHECK(difference(s, plain, s.grains.velocity, [](const auto& n) { return n.velocity; })
            < 1e-9);
        CHECK(difference(s, plain, node_forces(s), [](const auto& n) { return n.force; }) < 1e-8);
        CHECK(difference_of_points(s, plain) < 1e-9);
        for (std::size_t g = 0; g < s.bodies.size(); ++g) {
            const RigidBody& body = s.bodies[g];
            const plain_solid::Grain& grain = plain.grains[g];
            CHECK(norm(body.turn.v - grain.turn.v) < 1e-9);
            CHECK(norm(body.spin - grain.spin) < 1e-9 * std::max(norm(grain.spin), c.spin));
        }
        const Energies found = energies(s);
        const double all = expected.sum();
        CHECK(std::fabs(found.kinetic - expected.kinetic) < 1e-9 * all);
        CHECK(std::fabs(found.elastic - expected.strain - expected.contact) < 1e-9 * all);
        CHECK(std::fabs(found.damage - expected.damage) < 1e-9 * all);
        CHECK(std::fabs(found.friction - expected.friction) < 1e-9 * all);
        CHECK(std::fabs(found.damping + found.drag - plain.works.damping) < 1e-9 * all);
        CHECK(std::fabs(found.boundary_work - plain.works.boundary) < 1e-9 * all);
        const CrackCount cracks = count_cracks(s);
        CHECK(cracks.tensile + cracks.shear == solid_samples::cracked_points(plain));
        CAPTURE(cracks.tensile, cracks.shear, found.damage, found.friction);
        CHECK((c.steps < 400 || (cracks.tensile > 20 && found.friction > 0.0)));
        CHECK(s.bodies.empty() == !c.rigid);
    }
}
