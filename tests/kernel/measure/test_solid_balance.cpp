// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Momentum, angular momentum and energy of solids whose faces open, slide and part, and
/// stability, by the plain step of solids.
#include "support/catch.hpp"

#include "reference/solid_samples.hpp"

using namespace solid_samples;

namespace {

struct Momenta {
    Vector linear, angular;
    double scale = 0.0;  ///< sum of |m v|
};

/// Half a step after the places, which are taken there.
Momenta momenta(const Specimen& s, double dt)
{
    Momenta m;
    for (const Node& n : s.nodes) {
        if (n.rides) continue;
        const Vector p = n.mass * n.velocity;
        m.linear = m.linear + p;
        m.angular = m.angular + cross(n.place() + 0.5 * dt * n.velocity, p);
        m.scale += norm(p);
    }
    for (const Grain& g : s.grains)
        if (g.is_rigid()) m.angular = m.angular + g.angular_momentum;
    return m;
}

}  // namespace

TEST_CASE("Momentum and angular momentum stay while faces open, slide and part", "[solids]")
{
    const auto cells = packing(20, 6);
    for (const bool rigid : { false, true }) {
        Specimen s = make_specimen(cells, specimens::granite(), specimens::granite_contact(),
            { rigid, false, flexpm::FacePointRule::corners_and_inner });
        const double dt = 2e-8;
        kick(s, 20.0, 10000.0, 9);
        const Momenta before = momenta(s, dt);
        double energy = 0.0, first = 0.0, worst = 0.0;
        const int steps = 600;
        for (int k = 0; k < steps; ++k) {
            const double sum = step(s, dt, 0.0).sum();
            if (k == 0) first = sum;
            energy = sum;
            worst = std::max(worst, std::fabs(sum - first));
        }
        const Momenta after = momenta(s, dt);
        CHECK(norm(after.linear - before.linear) < 1e-12 * before.scale);
        CHECK(norm(after.angular - before.angular) < 1e-12 * before.scale * side);
        // faces have gone through all of it
        CHECK(cracked_points(s) > 20);
        CHECK(friction_energy(s) > 0.0);
        CAPTURE(rigid, energy, first, damage_energy(s));
        CHECK(worst < 2e-3 * first);
    }
}

TEST_CASE("The work on a solid is stored, lost in its faces or damped", "[solids]")
{
    for (const bool rigid : { false, true }) {
        const auto cells = packing(15, 8);
        Specimen s = make_specimen(cells, specimens::granite(), specimens::granite_contact(),
            { rigid, false, flexpm::FacePointRule::corners_and_inner });
        scale_masses(s, 1.0, 0.7);
        double top = 0.0;
        for (const Vector& v : cells.vertices)
            top = std::max(top, v.z);
        // the grains at both ends are held; of rigid ones the spin, too
        for (Grain& g : s.grains) {
            bool low = false, high = false;
            for (int n : g.nodes) {
                low = low || s.nodes[n].reference.z < 1e-9;
                high = high || s.nodes[n].reference.z > top - 1e-9;
            }
            if (!low && !high) continue;
            g.spin_held = rigid;
            for (int n : g.nodes) {
                s.nodes[n].held = { true, true, true };
                if (high) s.nodes[n].velocity = { 2e-8, 0.0, -0.5e-8 };
            }
        }
        Energies e;
        double largest = 0.0, worst = 0.0;
        for (int k = 0; k < 2500; ++k) {
            e = step(s, 1.0, 0.7);
            largest = std::max(largest, std::fabs(s.works.boundary));
            worst = std::max(worst, std::fabs(e.sum() + s.works.damping - s.works.boundary));
        }
        CAPTURE(rigid, e.kinetic, e.strain, e.contact, e.damage, e.friction, s.works.damping,
            s.works.boundary);
        CHECK(e.damage > 0.01 * largest);
        CHECK(e.friction > 0.01 * largest);
        CHECK(worst < 1e-3 * largest);
    }
}

TEST_CASE("A free rigid grain turns as Euler's equations say", "[solids]")
{
    Specimen s = make_specimen(packing(12, 5), specimens::granite(), specimens::granite_contact(),
        { true, false, flexpm::FacePointRule::one });
    s.contacts.clear();
    kick(s, 0.0, 1000.0, 3);
    const double dt = 1e-5;
    std::vector<Vector> momentum;
    std::vector<double> energy;
    for (const Grain& g : s.grains) {
        momentum.push_back(g.angular_momentum);
        energy.push_back(0.5 * dot(g.spin, g.angular_momentum));
    }
    for (int k = 0; k < 2000; ++k)
        step(s, dt, 0.0);
    double turned = 0.0;
    for (std::size_t k = 0; k < s.grains.size(); ++k) {
        const Grain& g = s.grains[k];
        CHECK(norm(g.angular_momentum - momentum[k]) < 1e-12 * norm(momentum[k]));
        // no drift; the turn of a step is up to 0.01 rad
        CHECK(0.5 * dot(g.spin, g.angular_momentum) == Approx(energy[k]).epsilon(1e-4));
        turned = std::max(turned, norm(g.spin) * dt * 2000.0);
    }
    CHECK(turned > 5.0);
}

TEST_CASE("A step is stable with the bound's masses", "[solids]")
{
    for (const bool rigid : { false, true }) {
        for (const double damping : { 0.0, 0.7 }) {
            Specimen s =
                make_specimen(packing(15, 3), specimens::granite(), specimens::strong_contact(),
                    { rigid, false, flexpm::FacePointRule::corners_and_inner });
            scale_masses(s, 1.0, damping);
            kick(s, 1e-12, 0.0, 2);
            flexpm::Random random(4);
            for (Node& n : s.nodes)
                if (!n.rides) n.velocity = n.velocity + 1e-12 * draw(random);
            const double first = step(s, 1.0, damping).sum();
            double last = 0.0;
            for (int k = 0; k < 600; ++k)
                last = step(s, 1.0, damping).sum();
            CHECK(last < 1.5 * first);
            if (damping > 0.0) CHECK(last < 0.1 * first);
        }
    }
}
