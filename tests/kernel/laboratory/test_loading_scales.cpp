// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Scales of a test against closed forms: bars of known wave speed, Mohr-Coulomb strengths.
/// SI units.
#include "support/catch.hpp"

#include <flexpm/kernel/laboratory/axial_measures.hpp>
#include <flexpm/kernel/laboratory/bond_strengths.hpp>
#include <flexpm/kernel/laboratory/loading_scales.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>

#include "support/specimens.hpp"

#include <cmath>
#include <vector>

using namespace flexpm;

TEST_CASE("A wave crosses an elastic bar in its height over sqrt(E / rho)")
{
    const double young = 25e9, density = 2650.0, width = 0.04, height = 0.1, thickness = 0.02;
    const double dt = 2e-8;
    const ScaleInputs bar = { young, 1e8, density * width * height * thickness, thickness, dt };
    const TestScales scales = rectangle_scales(bar, width, height);
    CHECK(scales.crossing_steps * dt == Approx(height / std::sqrt(young / density)));
    CHECK(scales.modulus == young);
    CHECK(scales.height == height);
    CHECK(scales.width == width);
}

TEST_CASE("A wave crosses a disc as it does a bar of the disc's area, and its plates close four "
          "times as much")
{
    const double young = 25e9, diameter = 0.08, thickness = 0.02;
    const double width = 0.25 * std::acos(-1.0) * diameter;
    const ScaleInputs in = { young, 8e6, 0.3, thickness, 1.0 };
    const TestScales disc = disc_scales(in, diameter);
    CHECK(disc.crossing_steps == Approx(rectangle_scales(in, width, diameter).crossing_steps));
    CHECK(disc.modulus == Approx(0.25 * young));
}

TEST_CASE(
    "The reference strength is that of Mohr and Coulomb in compression, of the contact in tension")
{
    const double phi = 0.6, cohesion = 30e6;
    const ContactStrength contact = { 8e6, cohesion, std::tan(phi) };
    CHECK(reference_strength(Sense::tension, contact) == 8e6);
    CHECK(reference_strength(Sense::compression, contact)
        == Approx(2.0 * cohesion * std::cos(phi) / (1.0 - std::sin(phi))));
}

TEST_CASE("Grains and contacts stand in series; rigid grains leave the contacts alone")
{
    const bool rigid = GENERATE(false, true);
    auto options = specimens::options();
    options.rigid = rigid;
    Assembly a = specimens::assemble(specimens::grid(3, 4, 2e-3), options);
    scale_masses(a, 0.7);
    const LawParameters& law = a.contacts.laws[0];
    const double contacts = law.normal_stiffness * 2.0 * a.grains.radius[0];
    const double young = a.grains.elastic[0].young;
    const ScaleInputs in = scale_inputs(a, Sense::compression, 1.0);
    CHECK(in.modulus == Approx(rigid ? contacts : young * contacts / (young + contacts)));
    CHECK(in.strength
        == reference_strength(
            Sense::compression, { law.tensile_strength, law.cohesion, law.friction }));
    CHECK(in.thickness == a.thickness);
    CHECK(in.mass > 0.0);
}

TEST_CASE("The lowest strength is the one that 1 % of the bonded area do not exceed")
{
    const auto bonds = [](double weak_area) {
        return std::vector<BondValue> { { 5.0, 100.0 - weak_area, { 0, 1 } },
            { 1.0, weak_area, { 1, 2 } }, { 7.0, 1e-3, { 2, 3 } } };
    };
    CHECK(lowest_value(bonds(0.9)) == 5.0);
    CHECK(lowest_value(bonds(1.1)) == 1.0);
    // two laws that are both rare count together
    CHECK(lowest_value({ { 5.0, 98.8, {} }, { 1.0, 0.6, {} }, { 2.0, 0.6, {} } }) == 2.0);
}

TEST_CASE("Bonds that connect half of the grains carry what the weaker ones have lost")
{
    // parents of three grains each, in a row: weak within, strong between, and the other way round
    std::vector<BondValue> weak_within, weak_between;
    for (int g = 0; g < 8; ++g) {
        const bool within = g % 3 != 2;
        weak_within.push_back({ within ? 0.001 : 1.0, 1.0, { g, g + 1 } });
        weak_between.push_back({ within ? 1000.0 : 1.0, 1.0, { g, g + 1 } });
    }
    // a chain through the middles of the parents
    CHECK(connecting_value(weak_within, 9) == 0.001);
    for (const int g : { 0, 3 })
        weak_within.push_back({ 1.0, 1.0, { g, g + 3 } });
    CHECK(connecting_value(weak_within, 9) == 1.0);
    CHECK(connecting_value(weak_between, 9) == 1.0);
    // where joints cut the specimen in two, half of one piece is enough
    CHECK(connecting_value({ { 3.0, 1.0, { 0, 1 } }, { 2.0, 1.0, { 2, 3 } } }, 4) == 3.0);
}

TEST_CASE("Strengths of a test are those of the laws of pairs, whatever single bonds have")
{
    const auto s = specimens::grid(3, 4, 2e-3);
    AssemblyOptions o = specimens::options();
    o.elastic.push_back(o.elastic[0]);
    const auto law = [](double tensile) {
        ContactMaterial m = specimens::granite_contact();
        m.tensile_fracture_energy *= tensile * tensile;
        m.tensile_strength *= tensile;
        return m;
    };
    // columns of grains 0 and 2 are of one kind, the middle one is of the other
    o.laws = { law(1.0), law(0.25), law(0.25), law(2.0) };
    o.grain_material = { 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0 };
    const double whole = specimens::granite_contact().tensile_strength;
    const ScaleInputs in = scale_inputs(specimens::assemble(s, o), Sense::tension, 1.0);
    CHECK(in.lowest_strength == Approx(0.25 * whole));
    CHECK(in.strength == Approx(0.25 * whole));  // the columns are connected by weak bonds alone
    o.laws = { law(0.25), law(1.0), law(1.0), law(2.0) };
    const ScaleInputs connected = scale_inputs(specimens::assemble(s, o), Sense::tension, 1.0);
    CHECK(connected.lowest_strength == Approx(0.25 * whole));
    CHECK(connected.strength == Approx(whole));
}

TEST_CASE("Both ends share the stress; what one has more than the other is their mismatch")
{
    // squeezed: the bottom pushes up, the top down
    CHECK(axial_stress({ 3.0, -5.0 }, Sense::compression, 2.0) == 2.0);
    CHECK(axial_stress({ -3.0, 5.0 }, Sense::tension, 2.0) == 2.0);
    CHECK(end_mismatch({ 3.0, -5.0 }) == Approx(0.4));
    CHECK(end_mismatch({ 0.0, 0.0 }) == 0.0);
    const double pi = std::acos(-1.0);
    const EndForces split = { 7.0, -7.0 };
    CHECK(axial_stress(split, Sense::compression, splitting_area(0.08, 0.02))
        == Approx(2.0 * 7.0 / (pi * 0.08 * 0.02)));
}

TEST_CASE(
    "What a contact holds at its strength is no part of the damage, and all there is if brittle")
{
    Assembly a = specimens::assemble(specimens::grid(2, 2, 2e-3), specimens::options());
    ContactMaterial m;
    m.normal_stiffness = 1e14;
    m.shear_ratio = 1.0;
    m.tensile_strength = 1e7;
    m.cohesion = 2e7;
    m.friction = 0.5;
    const double tensile = 0.5 * m.tensile_strength * m.tensile_strength / m.normal_stiffness;
    const double shear = 0.5 * m.cohesion * m.cohesion / m.normal_stiffness;
    m.tensile_fracture_energy = 10.0 * tensile;
    m.shear_fracture_energy = 4.0 * shear;
    a.contacts.laws = { make_law(m) };
    CHECK(damage_share(a) == Approx(0.75));
    m.tensile_fracture_energy = tensile;
    a.contacts.laws = { make_law(m) };
    CHECK(damage_share(a) == Approx(0.0).margin(1e-12));
}
