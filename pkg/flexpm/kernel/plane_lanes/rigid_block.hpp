// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  One block of rigid grains: a translation and a rotation each, with the local damping of
/// Eq. 2 on both. The nodes follow by exact rotation from the reference, however far it goes.
#pragma once

#include <flexpm/kernel/assembly/grains.hpp>
#include <flexpm/kernel/core/central_difference.hpp>

#include <cstdint>

namespace flexpm {

/// The rows of one block of rigid grains; the last node is the centre.
struct RigidRows {
    int nodes;
    const double* reference;
    double* displacement;
    double* velocity;
    const double* undamped_velocity;  ///< of the centre; null where no step is done
    const double* force;
    const std::uint8_t* prescribed;  ///< of the centre
    const double* inverse_mass;      ///< of the centre
    double* rotation;                ///< [RotationRow]
    double* spin;
    const double* undamped_spin;  ///< likewise
    const std::uint8_t* spin_prescribed;
    const double* inverse_inertia;
};

/// Move the grains to the end of the step; then new velocities and spins from the nodal forces and
/// their moments about the centres, and velocities of all nodes so that dt times them is the exact
/// way of the coming step.
///
/// @param measure  also sum kinetic energy and largest unbalanced force
void step_rigid(const RigidRows& b, double dt, double damping, bool measure, StepSums& sums);

/// Velocities of all nodes from those of the centre and the spin.
void spread_velocities(const RigidRows& b, double dt);

}  // namespace flexpm
