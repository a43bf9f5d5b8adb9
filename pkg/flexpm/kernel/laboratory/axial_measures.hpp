// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  What an axial test records of a rectangle between its bottom and top, or of a disc between two plates,
/// paper Sec. 4.1. Stress and strain are magnitudes: positive in compression, or in tension in a tension test.
#pragma once

#include <flexpm/kernel/laboratory/loading_scales.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/measure/specimen_strain.hpp>

#include <cstdint>

namespace flexpm {

/// Forces along y that hold a specimen at its ends [N].
struct EndForces {
    double bottom = 0.0;
    double top = 0.0;
};

/// Mean of both ends' forces over an area, positive in the sense of the loading [Pa].
double axial_stress(const EndForces& ends, Sense sense, double area);

/// |sum of both ends' forces| over the larger [-]; 0 without a force.
double end_mismatch(const EndForces& ends);

/// Area over which the force of a Brazilian test gives its stress 2 P / (pi D t) [m^2].
double splitting_area(double diameter, double thickness);

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
    double velocity_factor = 1.0;  ///< velocity of the loading over its slowest [-]
    CrackCount cracks;
    Energies energies;
};

/// Name of the first value that is not a finite number, null if all are; a lateral strain need not be there.
const char* find_bad_value(const AxialObservation& now);

/// Axial stress above the confinement [Pa]: what the end of a test goes by.
double differential_stress(const AxialObservation& now);

/// The part of an observation that every test has; strains and confinement are zero.
AxialObservation observe_ends(const Assembly& a, const EndForces& ends, Sense sense, double area);

AxialGeometry rectangle_of(const Assembly& a, Sense sense);

/// Lateral strain of a rectangle where nodes move so, in the layout of Grains::displacement; positive as Poisson's effect [-].
double lateral_strain(const Assembly& a, Sense sense, const Array<double>& moved);

/// Observation of the last step, which must have been measured.
AxialObservation observe(const Assembly& a, const AxialGeometry& geometry);

/// The same of a disc between a lower and an upper plate, the first two of the assembly: strains are
/// the closure of the plates and the widening of the disc over its diameter, the stress is the
/// tensile one of an elastic disc's centre, 2 P / (pi D t), with P the mean of both plates' forces.
AxialObservation observe_disc(const Assembly& a, double diameter);

}  // namespace flexpm
