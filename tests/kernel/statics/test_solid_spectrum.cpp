// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Largest frequency of solids, and masses that come close to what it asks for.
#include "support/catch.hpp"

#include <flexpm/kernel/laboratory/solid_ends.hpp>
#include <flexpm/kernel/statics/solid_spectrum.hpp>

#include "support/solid_states.hpp"

using namespace solid_states;

namespace {

/// Energy after steps of a size over that of the first, from random velocities.
double growth(SolidState s, double dt, double damping, int steps = 600)
{
    Random random(4);
    for_each_node(s, [&](int grain, int number) {
        set_space_vector(
            s.grains.velocity, s.grains.node(grain, number), 1e-12 * solid_samples::draw(random));
    });
    double first = 0.0, last = 0.0;
    for (int k = 0; k < steps; ++k) {
        step(s, { dt, damping, 1, true });
        const Energies e = energies(s);
        last = e.kinetic + e.elastic;
        if (k == 0) first = last;
    }
    return std::fabs(last / first);
}

}  // namespace

TEST_CASE("Two rigid cubes swing at the frequency of their contact", "[solids]")
{
    const double d = solid_samples::side;
    const double stiffness = specimens::granite_contact().normal_stiffness * d * d;
    SolidState s = make_solid(solid_samples::brick(1, 1, 2), Solid::box(d, d, 2.0 * d),
        granite(FacePointRule::corners_and_inner, true));
    // turns are slow
    for (RigidBody& body : s.bodies)
        body.inertia = { 1.0, 1.0, 1.0, 0.0, 0.0, 0.0 };
    const double inverse = s.grains.inverse_mass[s.grains.scalar_index(s.grains.centre(0))];
    CHECK(largest_square_frequency(s) == Approx(2.0 * stiffness * inverse).epsilon(0.02));
}

TEST_CASE("Masses close to the largest frequency keep a solid stable, and hardly more", "[solids]")
{
    const Packing p = packing(30, 3);
    for (const bool rigid : { false, true }) {
        SolidInput input = granite(FacePointRule::corners_and_inner, rigid);
        input.contacts = { specimens::strong_contact() };
        SolidState s = make_solid(p.cells, p.solid, input), loose = s;
        scale_masses(loose, 0.0);
        scale_masses_closely(s, 0.0);
        const int centre = s.grains.scalar_index(s.grains.centre(0));
        const double gain =
            std::sqrt(s.grains.inverse_mass[centre] / loose.grains.inverse_mass[centre]);
        CAPTURE(rigid, gain);
        CHECK(gain > 1.02);
        CHECK(growth(s, 1.0, 0.0) < 1.5);
        CHECK(growth(s, 1.08, 0.0, 40) > 1e3);
        scale_masses_closely(s, 0.7);
        CHECK(growth(s, 1.0, 0.7) < 0.1);
    }
}
