// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Energies of grains and of contacts, `lanes` at a time, summed in a fixed order.
#pragma once

#include <flexpm/kernel/assembly/contacts.hpp>
#include <flexpm/kernel/assembly/grains.hpp>

namespace flexpm {

/// Stored in the triangles of all grains [J].
double strain_energy(const Grains& grains);

/// Stored in all contact points [J].
double contact_energy(const Contacts& contacts);

/// Dissipated in all contact points [J].
struct ContactLoss {
    double damage = 0.0;
    double friction = 0.0;
};

ContactLoss contact_loss(const Contacts& contacts);

/// Dissipated by damage in points that have softened and not cracked [J].
double softened_energy(const Contacts& contacts);

/// Sum of the magnitudes of all contact forces [N].
double sum_of_forces(const Contacts& contacts);

}  // namespace flexpm
