// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  One step of the assembly: central differences with local damping, paper Eqs. 1-19.
///
/// A step moves the nodes by their velocities, updates contacts, boundary pressure and elements at
/// the new positions, and then integrates the velocities: positions and forces belong to step n,
/// velocities to n + 1/2. Velocities set between two steps (prescribed nodes) therefore act at
/// once.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>
#include <flexpm/kernel/assembly/step_options.hpp>
#include <flexpm/kernel/forces/outer_forces.hpp>

namespace flexpm {

/// @throws std::invalid_argument  if an option is out of range or prepare_step() has not been
///         called
void step(Assembly& a, const StepOptions& options);

/// Fill `shown_position` and keep it up to date from now on.
void show_positions(Assembly& a);

}  // namespace flexpm
