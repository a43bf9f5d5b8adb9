// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  A box pressed and pulled between frictionless ends to its peak, from the static solution.
#include "support/catch.hpp"

#include <flexpm/kernel/statics/solid_constants.hpp>

#include "support/solid_states.hpp"

using namespace solid_states;

namespace {

constexpr double damping = 0.7;

struct Run {
    SolidState state;
    std::vector<int> bottom, top;
    double height, section, young;

    double stress() const { return holding_force(state, top, 2) / section; }
    double strain() const
    {
        return state.grains.displacement[state.grains.component(top.front(), 2)] / height;
    }
};

/// At a strain that breaks nothing, strained on by `rate` in each step.
Run begun(const Packing& p, double strain, double rate)
{
    const auto grain = specimens::granite();
    const auto contact = specimens::granite_contact();
    const SolidExtension e = solid_extension(p.cells, p.solid,
        SolidElasticity {
            grain.young, grain.poisson, contact.normal_stiffness, contact.shear_ratio });
    Run r { make_solid(p.cells, p.solid, granite()), {}, {}, p.solid.high.z,
        p.solid.volume / p.solid.high.z, e.constants.youngs_modulus };
    r.bottom = side_nodes(r.state, SolidSide::bottom);
    r.top = side_nodes(r.state, SolidSide::top);
    scale_masses(r.state, damping);
    prescribe(r.state, r.bottom, 2, 0.0);
    prescribe(r.state, r.top, 2, rate * r.height);
    begin_from(r.state, { e.field, {} }, strain, rate);
    return r;
}

struct Peak {
    double stress = 0.0, strain = 0.0, last = 0.0, imbalance = 0.0, work = 0.0;
    int steps = 0;
};

/// Steps until the stress has fallen by a third from its peak.
Peak carried_out(Run& r, int most)
{
    Peak peak;
    while (peak.steps < most) {
        const bool look = peak.steps % 20 == 0;
        step(r.state, { 1.0, damping, 1, look });
        ++peak.steps;
        peak.last = std::fabs(r.stress());
        if (peak.last > peak.stress) {
            peak.stress = peak.last;
            peak.strain = r.strain();
        }
        if (!look) continue;
        const Energies e = energies(r.state);
        const double given = e.boundary_work + e.initial;
        peak.imbalance = std::max(peak.imbalance,
            std::fabs(e.kinetic + e.elastic + e.damage + e.friction + e.damping + e.drag - given));
        peak.work = std::max(peak.work, given);
        if (peak.last < 0.67 * peak.stress) break;
    }
    return peak;
}

}  // namespace

TEST_CASE("A solid begins at the stress of its static solution and keeps its modulus", "[solids]")
{
    const double strain = -2e-5, rate = -2e-7;
    Run r = begun(box(60, 2), strain, rate);
    const double kinetic = kinetic_of_velocities(r.state);
    step(r.state, { 1.0, damping, 1, true });
    CHECK(r.strain() == Approx(strain + rate).epsilon(1e-9));
    CHECK(r.stress() == Approx(r.young * (strain + rate)).epsilon(2e-3));
    for (int k = 0; k < 100; ++k)
        step(r.state, { 1.0, damping, 1, true });
    CHECK(r.stress() == Approx(r.young * r.strain()).epsilon(2e-3));
    CHECK(count_cracks(r.state).tensile == 0);
    // without the motion of the solution damping would hold it back
    CHECK(energies(r.state).kinetic == Approx(kinetic).epsilon(0.02));
}

TEST_CASE("A box is pressed and pulled to its peak", "[solids][many_steps]")
{
    const Packing p = box(60, 2);
    for (const double sense : { -1.0, 1.0 }) {
        Run r = begun(p, sense * 2e-5, sense * (sense < 0.0 ? 1e-6 : 2e-7));
        const Peak peak = carried_out(r, 12000);
        const CrackCount cracks = count_cracks(r.state);
        const Energies e = energies(r.state);
        CAPTURE(sense, peak.stress, peak.strain, peak.last, peak.steps, r.young, cracks.tensile,
            cracks.shear, e.damage, e.friction, peak.imbalance, peak.work);
        CHECK(peak.last < 0.67 * peak.stress);
        CHECK(cracks.tensile > 20);
        CHECK(e.damage > 0.05 * peak.work);
        CHECK(peak.imbalance < 2e-3 * peak.work);
        const double strength = specimens::granite_contact().tensile_strength;
        if (sense > 0.0) {
            CHECK(peak.stress > strength);
            CHECK(peak.stress < 2.0 * strength);
        } else {
            CHECK(peak.stress > 5.0 * strength);
            CHECK(peak.stress < 30.0 * strength);
        }
    }
}
