// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The balance that the energies must keep. SI units.
#pragma once

#include <flexpm/kernel/measure/energy_balance.hpp>

namespace balance {

/// All that is stored, dissipated or has been erased [J].
inline double total(const flexpm::Energies& e)
{
    return e.kinetic + e.elastic + e.damage + e.friction + e.damping + e.drag + e.potential
        + e.erased;
}

/// What the balance lacks [J]: work and initial energy less that.
inline double miss(const flexpm::Energies& e) { return e.boundary_work + e.initial - total(e); }

}  // namespace balance
