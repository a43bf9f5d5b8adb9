// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  What an axial test records of a specimen in its frame, paper Sec. 4.1. Stress and strain
/// are magnitudes: positive in compression, or in tension in a tension test.
#pragma once

#include <flexpm/kernel/laboratory/test_frame.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>

#include <cstdint>

namespace flexpm {

/// Mean of both ends' forces over an area, positive in the sense of the loading [Pa].
double axial_stress(const EndForces& ends, Sense sense, double area);

/// |sum of both ends' forces| over the larger [-]; 0 without a force.
double end_mismatch(const EndForces& ends);

/// One row of the test's record.
struct AxialObservation {
    std::int64_t step = 0;
    double axial_strain = 0.0;    ///< see TestStrains [-]
    double lateral_strain = 0.0;  ///< likewise [-]
    double axial_stress = 0.0;    ///< mean reaction of both ends / area [Pa]
    double confinement = 0.0;     ///< lateral pressure [Pa]
    double end_mismatch = 0.0;    ///< |sum of both ends' reactions| / the larger [-]
    double unbalanced_ratio = 0.0;
    double velocity_factor = 1.0;  ///< velocity of the loading over its slowest [-]
    CrackCount cracks;
    Energies energies;
};

/// Name of the first value that is not a finite number, null if all are; a lateral strain need not
/// be there.
const char* find_bad_value(const AxialObservation& now);

/// Axial stress above the confinement [Pa]: what the end of a test goes by.
double differential_stress(const AxialObservation& now);

/// Observation of the last step, which must have been measured.
template <class State> AxialObservation observe(const State& s, const StateFrame<State>& frame)
{
    const EndForces ends = frame.ends(s);
    const TestStrains strains = frame.strains(s);
    AxialObservation o;
    o.step = s.step;
    o.axial_strain = strains.axial;
    o.lateral_strain = strains.lateral;
    o.axial_stress = axial_stress(ends, frame.sense, frame.area);
    o.confinement = frame.confinement ? frame.confinement(s) : 0.0;
    o.end_mismatch = end_mismatch(ends);
    o.unbalanced_ratio = unbalanced_ratio(s);
    o.cracks = count_cracks(s);
    o.energies = energies(s);
    return o;
}

}  // namespace flexpm
