// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Axial loading of a rectangle between its bottom and top: what a test measures, when it ends,
/// and how fast it may be driven, paper Sec. 4.1. Stress and strain are magnitudes: positive in
/// compression, or in tension in a tension test.
/// Deviation D5: the printed velocity of 6.25e-7 m/s is not metres per unit step; the rate follows
/// from the slowest wave through the scaled masses.
#pragma once

#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/measure/specimen_strain.hpp>

#include <cstdint>

namespace flexpm {

enum class Sense { compression, tension };

/// Reference size of the specimen [m].
struct AxialGeometry {
    double width = 0.0;
    double height = 0.0;
    Sense sense = Sense::compression;
};

/// One row of the test's record.
struct AxialObservation {
    std::int64_t step = 0;
    double axial_strain = 0.0;    ///< specimen_strain() [-]
    double lateral_strain = 0.0;  ///< positive as Poisson's effect [-]
    double axial_stress = 0.0;    ///< mean reaction of both ends / initial area [Pa]
    double confinement = 0.0;     ///< pressure on the right side [Pa]
    double end_mismatch = 0.0;    ///< |sum of both ends' reactions| / the larger [-]
    double unbalanced_ratio = 0.0;
    double pace = 1.0;  ///< of the loading, over its slowest [-]
    CrackCount cracks;
    Energies energies;
};

/// When a test has shown what it is made for.
struct AxialEnd {
    double stop_ratio = 0.5;  ///< ends once the stress has fallen below this part of the peak [-]
    double least_peak = 0.0;  ///< no fall counts before the stress has reached this [Pa]
    double largest_strain = 0.0;  ///< ends here in any case [-]
};
enum class TestState { running, past_peak, largest_strain_reached };

/// @param peak  largest stress so far [Pa]
TestState judge(const AxialObservation& now, double peak, const AxialEnd& end);

AxialGeometry rectangle_of(const Assembly& a, Sense sense);

/// Of the last step, which must have been measured.
AxialObservation observe(const Assembly& a, const AxialGeometry& geometry);

/// The same of a disc between a lower and an upper plate, the first two of the assembly: strains are
/// the closure of the plates and the widening of the disc over its diameter, the stress is the
/// tensile one of an elastic disc's centre, 2 P / (pi D t), with P the mean of both plates' forces.
AxialObservation observe_disc(const Assembly& a, double diameter);

/// Hold the bottom axially and one of its nodes laterally; nothing moves yet.
void grip_bottom(Assembly& a);

/// Move the top at `velocity` [m/s], positive away from the bottom.
void move_top(Assembly& a, double velocity);

/// Series modulus of grains and contacts: 1/E = 1/E_grain + 1/(K_n d), d the mean disc diameter; of
/// rigid grains K_n d [Pa].
double series_modulus(const Assembly& a);

/// Steps (of `dt`) in which a wave of the scaled masses crosses the height: sqrt(M H / (E A)) / dt.
double crossing_steps(const Assembly& a, double dt);

/// Strength that the contacts alone would give the specimen [Pa]: 2 c cos(phi) / (1 - sin(phi)) with
/// c and tan(phi) of the first law in compression, its tensile strength in tension. A scale for the
/// loading rate and for the default end of a test, no prediction.
double reference_strength(const Assembly& a, Sense sense);

/// Scales of a test, for its loading rate and its default end.
struct TestScales {
    double crossing_steps = 0.0;  ///< steps in which a wave of the scaled masses crosses the height
    double modulus = 0.0;         ///< stress over strain of the record, roughly [Pa]
    double strength = 0.0;        ///< reference_strength() [Pa]
    double height = 0.0;          ///< [m]
    double width = 0.0;           ///< [m]
};
TestScales rectangle_scales(const Assembly& a, Sense sense, double dt);

/// Of observe_disc(): its plates close about four times as much as a strip of the disc's material
/// strains under the recorded stress.
TestScales disc_scales(const Assembly& a, double diameter, double dt);

/// Part of the full value in the coming step of an even ramp over `ramp_steps`.
double ramp_factor(std::int64_t step, int ramp_steps);

}  // namespace flexpm
