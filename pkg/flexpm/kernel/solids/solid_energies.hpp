// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Energies of a specimen in space and its cracks. SI units.
#pragma once

#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/solids/solid_state.hpp>

namespace flexpm {

/// Energies as of the plane. The kinetic one is that of the last measured step.
Energies energies(const SolidState& s);

/// Cracked points.
CrackCount count_cracks(const SolidState& s);

}  // namespace flexpm
