// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Energies of grains and of contacts, `lanes` at a time, summed in a fixed order.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

namespace flexpm {

/// Stored in the triangles of all grains [J].
double strain_energy(const Assembly& a);

/// Stored in all contact points [J].
double contact_energy(const Assembly& a);

/// Dissipated in all contact points [J].
struct ContactLoss {
    double damage = 0.0;
    double friction = 0.0;
};

ContactLoss contact_loss(const Assembly& a);

/// Sum of the magnitudes of all contact forces [N].
double sum_of_forces(const Assembly& a);

}  // namespace flexpm
