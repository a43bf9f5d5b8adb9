// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Motion of the nodes of deformable grains in space, `lanes` of their components at a time.
#pragma once

#include <flexpm/kernel/assembly/solid_state.hpp>
#include <flexpm/kernel/core/central_difference.hpp>

namespace flexpm {

/// Move the nodes of a block of grains to the end of a step.
void move_grain(SolidState& s, int block, double dt);

/// Leave no force on the nodes of blocks of grains.
void clear_forces(SolidState& s, int first, int end);

/// Integrate the velocities of the nodes of a block of grains.
void integrate_grain(
    SolidState& s, int block, double dt, double damping, bool measure, StepSums& sums);

}  // namespace flexpm
