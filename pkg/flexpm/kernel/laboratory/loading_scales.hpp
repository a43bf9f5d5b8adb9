// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Scales of a test: modulus, strength and the time of a wave, from which its loading rate
/// and its default end follow, paper Sec. 4.1. They are functions of plain numbers, for grains and
/// for the bonded spheres of a host program. SI units.
/// Deviation D5: the printed velocity of 6.25e-7 m/s is not metres per unit step; the rate follows
/// from the slowest wave through the scaled masses.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>
#include <flexpm/kernel/laboratory/bond_strengths.hpp>

namespace flexpm {

enum class Sense { compression, tension };

/// Stress over strain of a row of grains that are stiff against their contacts: K_n d [Pa].
double contact_modulus(double normal_stiffness, double mean_diameter);

/// Stress over strain of grains and contacts in series, 1/E = 1/E_grain + 1/E_contacts [Pa].
double series_modulus(double of_grains, double of_contacts);

/// Strengths of a contact.
struct ContactStrength {
    double tensile = 0.0;   ///< [Pa]
    double cohesion = 0.0;  ///< [Pa]
    double friction = 0.0;  ///< coefficient [-]
};

/// Strength that the contacts alone would give a specimen [Pa]: their tensile strength in tension,
/// 2 c cos(phi) / (1 - sin(phi)) with tan(phi) the friction in compression. A scale, no prediction.
double reference_strength(Sense sense, const ContactStrength& contact);

/// What the scales of a test follow from.
struct ScaleInputs {
    double modulus = 0.0;       ///< contact_modulus() or series_modulus() [Pa]
    double strength = 0.0;      ///< reference_strength() of the bonds that connect the grains [Pa]
    double mass = 0.0;          ///< of all that moves, scaled or real [kg]
    double thickness = 0.0;     ///< [m]
    double dt = 1.0;            ///< of a step [s], 1 with scaled masses
    double damage_share = 0.0;  ///< damage_share() [-]
    double lowest_strength = 0.0;  ///< reference_strength() of the weakest bonds that count [Pa]
};

/// Scales of a test, for its loading rate and its default end.
struct TestScales {
    double crossing_steps =
        0.0;                ///< steps in which a wave crosses the height, sqrt(M H / (E A)) / dt
    double modulus = 0.0;   ///< stress over strain of the record, roughly [Pa]
    double strength = 0.0;  ///< reference_strength() of the bonds that connect the grains [Pa]
    double height = 0.0;    ///< [m]
    double width = 0.0;     ///< [m]
    double damage_share =
        0.0;  ///< damage_share() of the contacts; 0 of bonds that break at once [-]
    /// Strain of the record at which a specimen of that size would fail as a whole, where the
    /// strength follows from its first contact point that softens; else 0 [-].
    double failure_strain = 0.0;
    /// reference_strength() of the weakest bonds that count [Pa]; between parts that of the first
    /// contact point that softens.
    double lowest_strength = 0.0;
};
TestScales rectangle_scales(const ScaleInputs& inputs, double width, double height);

/// Scales of a disc between two plates, which close about four times as much as a strip of the
/// disc's material strains under the recorded stress.
TestScales disc_scales(const ScaleInputs& inputs, double diameter);

/// Least part of its fracture energies that damage takes at a contact's points [-]; 0 in the
/// brittle limit.
double damage_share(const LawParameters& law);

/// The least of the pairs of kinds of grains that count [-], see lowest_value(). The rest is
/// elastic energy, which a contact has at its strength and releases.
double damage_share(const Assembly& a);

/// Compression over an extent of the specimen at which it would fail as a whole [m].
double failure_displacement(const ScaleInputs& compressed, double extent);

/// Fill strengths and damage share from the laws of the bonds that count.
/// @param counts  see bond_values()
template <class State, class Counts>
void take_bonds(ScaleInputs& in, const State& s, Sense sense, const Counts& counts)
{
    const auto strength = [&](const LawParameters& law) {
        return reference_strength(sense, { law.tensile_strength, law.cohesion, law.friction });
    };
    const auto share = [](const LawParameters& law) { return damage_share(law); };
    if (s.grains.elastic.size() == 1) {  // inner particles have laws of their own within a grain
        const LawParameters& law = s.contacts.laws[s.grains.law_index(0, 0)];
        in.strength = in.lowest_strength = strength(law);
        in.damage_share = share(law);
        return;
    }
    const auto strengths = bond_values(s, counts, strength);
    in.strength = connecting_value(strengths, s.grains.count);
    in.lowest_strength = lowest_value(strengths);
    in.damage_share = lowest_value(bond_values(s, counts, share));
}

/// The inputs of bonded grains; the modulus is of means over all of them, of rigid grains it is a
/// contact_modulus().
ScaleInputs scale_inputs(const Assembly& a, Sense sense, double dt);

}  // namespace flexpm
