// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Energies of a specimen in space and its cracks. SI units.
#pragma once

#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/assembly/solid_state.hpp>

#include <string>

namespace flexpm {

/// Kinetic energy as if no force acted on the present velocities and spins, of what is free [J].
double kinetic_of_velocities(const SolidState& s);

/// Energies as of the plane. The kinetic one is that of the last measured step.
Energies energies(const SolidState& s);

/// Those of the energies that say what a loading does to the specimen.
Dissipation dissipation(const SolidState& s);

/// Power that local damping takes from the motion of grains and loaded plates beyond the motion
/// that it leaves alone, as of the plane [W, or J per unit step].
double damping_power(const SolidState& s, double damping);

/// Ratio of the largest unbalanced force to the mean contact force [-], at the last measured step;
/// as of the plane (deviation D103).
double unbalanced_ratio(const SolidState& s);

/// Cracked points.
CrackCount count_cracks(const SolidState& s);

/// Empty if all is well, else one line that names the step, the grain and the quantity that is not
/// a finite number.
std::string find_bad_number(const SolidState& s);

}  // namespace flexpm
