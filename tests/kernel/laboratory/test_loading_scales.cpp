// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Scales of a test against closed forms: bars of known wave speed, Mohr-Coulomb strengths.
/// SI units.
#include "support/catch.hpp"

#include <flexpm/kernel/laboratory/axial_measures.hpp>
#include <flexpm/kernel/laboratory/loading_scales.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>

#include "support/specimens.hpp"

#include <cmath>

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
