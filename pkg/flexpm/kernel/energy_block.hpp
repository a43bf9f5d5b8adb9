// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Energies of grains and of contacts, `lanes` at a time, summed in a fixed order.
#pragma once

#include <flexpm/kernel/assembly.hpp>

namespace flexpm {

/// Stored in the triangles of all grains [J].
double strain_energy(const Assembly& a);

/// Of all contact points [J].
struct ContactEnergy {
    double elastic = 0.0;
    double damage = 0.0;    ///< dissipated
    double friction = 0.0;  ///< dissipated
};

ContactEnergy contact_energy(const Assembly& a);

}  // namespace flexpm
