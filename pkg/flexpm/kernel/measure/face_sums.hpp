// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Energies and forces of the faces between polyhedral grains, `lanes` at a time, summed in a
/// fixed order.
#pragma once

#include <flexpm/kernel/assembly/solid_state.hpp>
#include <flexpm/kernel/measure/energy_sums.hpp>

namespace flexpm {

/// Stored in all points of faces [J].
double contact_energy(const SolidState& s);

/// Dissipated in all points of faces [J].
ContactLoss contact_loss(const FaceContacts& contacts);

/// Dissipated by damage in points that have softened and not cracked [J].
double softened_energy(const FaceContacts& contacts);

/// Sum of the magnitudes of the forces of all faces [N].
double sum_of_forces(const SolidState& s);

}  // namespace flexpm
