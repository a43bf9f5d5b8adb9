// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  End of a test: the one rule for grains and for the bonded spheres of a host program. SI
/// units.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>

namespace flexpm {

/// When a test has shown what it is made for. Stresses are deviators: axial stress minus the least
/// lateral pressure.
struct TestEnd {
    double stop_ratio = 0.5;  ///< over once the stress has fallen below this part of its peak [-]
    double least_peak = 0.0;  ///< no fall counts before the stress has reached this [Pa]
    double least_strain = -std::numeric_limits<double>::infinity();   ///< over at this or below [-]
    double largest_strain = std::numeric_limits<double>::infinity();  ///< over at this or above [-]
    /// Over once the stress has been constant, within `plateau_band`, over this strain [-]; 0: a
    /// plateau does not end the test.
    double plateau_strain = 0.0;
};

enum class TestState {
    running,
    past_peak,
    least_strain_reached,
    largest_strain_reached,
    plateau_reached
};

/// Range of the stresses on a plateau over the largest of them [-].
constexpr double plateau_band = 0.02;

/// One row of a record: axial strain [-] and deviator [Pa].
struct StrainStress {
    double strain, stress;
};

/// Whether the last rows of a record are a plateau of the strain that the rule requires.
///
/// @param row    gives the row of an index
/// @param first  index of the first row of the loading
/// @param end    index behind the last row
bool is_plateau(const std::function<StrainStress(std::size_t)>& row, std::size_t first,
    std::size_t end, const TestEnd& rule);

/// State of a test with these last readings, positive in the sense of the loading.
///
/// @param stress  axial stress above the confinement [Pa]: a confined specimen that carries no more
///                than the confinement has lost all of its strength
/// @param peak    largest such stress so far [Pa]
/// @param strain  axial strain [-]
/// @param plateau  the last rows are a plateau, see is_plateau()
/// @throws std::invalid_argument  if not 0 <= stop_ratio <= 1, a limit is no number, or the strain
///                                of a plateau is negative
TestState test_state(
    double stress, double peak, double strain, const TestEnd& end, bool plateau = false);

}  // namespace flexpm
