// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/loading_scales.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/vector.hpp>

#include <algorithm>
#include <cmath>

namespace flexpm {

namespace {

double crossing_steps(const ScaleInputs& in, double width, double height)
{
    return std::sqrt(in.mass * height / (in.modulus * width * in.thickness)) / in.dt;
}

double mean_modulus(const Assembly& a)
{
    double diameter = 0.0;
    for (double r : a.grains.radius)
        diameter += 2.0 * r / a.grains.count;
    const double of_contacts = contact_modulus(
        grain_mean(a.grains, [&](int g) { return own_law(a, g).normal_stiffness; }), diameter);
    if (a.grains.is_rigid(0)) return of_contacts;
    return series_modulus(
        grain_mean(a.grains, [&](int g) { return a.grains.elastic[a.grains.material[g]].young; }),
        of_contacts);
}

}  // namespace

double contact_modulus(double normal_stiffness, double mean_diameter)
{
    return normal_stiffness * mean_diameter;
}

double series_modulus(double of_grains, double of_contacts)
{
    return 1.0 / (1.0 / of_grains + 1.0 / of_contacts);
}

double reference_strength(Sense sense, const ContactStrength& contact)
{
    if (sense == Sense::tension) return contact.tensile;
    const double mu = contact.friction;
    // cos(phi) / (1 - sin(phi)) with tan(phi) = mu
    return 2.0 * contact.cohesion * (std::sqrt(1.0 + mu * mu) + mu);
}

TestScales rectangle_scales(const ScaleInputs& inputs, double width, double height)
{
    return { crossing_steps(inputs, width, height), inputs.modulus, inputs.strength, height, width,
        inputs.damage_share, 0.0, inputs.lowest_strength };
}

TestScales disc_scales(const ScaleInputs& inputs, double diameter)
{
    return { crossing_steps(inputs, 0.25 * pi * diameter, diameter), 0.25 * inputs.modulus,
        inputs.strength, diameter, diameter, inputs.damage_share, 0.0, inputs.lowest_strength };
}

double damage_share(const LawParameters& law)
{
    const double slip = law.cohesion / law.shear_stiffness;
    const double elastic =
        std::max(law.elastic_opening / law.critical_opening, slip / law.critical_slip);
    return std::max(1.0 - elastic, 0.0);
}

double damage_share(const Assembly& a) { return scale_inputs(a, Sense::tension, 1.0).damage_share; }

double failure_displacement(const ScaleInputs& compressed, double extent)
{
    return compressed.strength / compressed.modulus * extent;
}

ScaleInputs scale_inputs(const Assembly& a, Sense sense, double dt)
{
    ScaleInputs in;
    in.modulus = mean_modulus(a);
    for (double m : a.grains.inverse_mass)
        in.mass += m > 0.0 ? 1.0 / m : 0.0;
    in.thickness = a.thickness;
    in.dt = dt;
    const Contacts& contacts = a.contacts;
    take_bonds(
        in, a, sense, [&](int c) { return contacts.bonded[c] != 0 && contacts.joint[c] < 0; });
    return in;
}

}  // namespace flexpm
