// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Motion of the nodes of one block of deformable grains, each free of the others, paper
/// Eqs. 1-3.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>
#include <flexpm/kernel/core/central_difference.hpp>

#include <cstdint>

namespace flexpm {

/// The rows of the nodes of one block of grains.
struct NodeRows {
    int nodes;
    double* displacement;
    double* velocity;
    const double* undamped_velocity;  ///< part of `velocity` that damping does not act on
    const double* force;
    const std::uint8_t* prescribed;
    const double* inverse_mass;
};
NodeRows node_rows(Assembly& a, int block);

/// Move the nodes to the end of the step.
void move_nodes(const NodeRows& b, double dt);

/// New velocities from the nodal forces.
///
/// @param measure  also sum kinetic energy and largest unbalanced force
void integrate_nodes(const NodeRows& b, double dt, double damping, bool measure, StepSums& sums);

}  // namespace flexpm
