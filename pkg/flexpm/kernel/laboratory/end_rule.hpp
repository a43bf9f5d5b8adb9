// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  End of a test: the one rule for grains and for the bonded spheres of a host program. SI
/// units.
#pragma once

#include <limits>

namespace flexpm {

/// When a test has shown what it is made for. Stresses are those above the confinement.
struct TestEnd {
    double stop_ratio = 0.5;  ///< over once the stress has fallen below this part of its peak [-]
    double least_peak = 0.0;  ///< no fall counts before the stress has reached this [Pa]
    double least_strain = -std::numeric_limits<double>::infinity();   ///< over at this or below [-]
    double largest_strain = std::numeric_limits<double>::infinity();  ///< over at this or above [-]
};

enum class TestState { running, past_peak, least_strain_reached, largest_strain_reached };

/// State of a test with these last readings, positive in the sense of the loading.
///
/// @param stress  axial stress above the confinement [Pa]: a confined specimen that carries no more
///                than the confinement has lost all of its strength
/// @param peak    largest such stress so far [Pa]
/// @param strain  axial strain [-]
/// @throws std::invalid_argument  if not 0 <= stop_ratio <= 1, or a limit is no number
TestState test_state(double stress, double peak, double strain, const TestEnd& end);

}  // namespace flexpm
