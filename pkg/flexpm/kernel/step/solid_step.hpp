// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  One step of a specimen in 3D, of deformable or rigid polyhedral grains.
#pragma once

#include <flexpm/kernel/assembly/solid_plan.hpp>
#include <flexpm/kernel/step/step.hpp>

namespace flexpm {

/// Find the forces at the present places, and the states of contact points there, without a step.
/// @throws std::invalid_argument  if a contact has no middle face there
void find_forces(SolidState& s);

/// Move all nodes, find the forces at the new places, and integrate the velocities. All sums run in
/// a fixed order: results do not depend on the number of threads.
///
/// @throws std::invalid_argument  if an option is out of range or prepare_step() has not been
///         called
/// @throws std::runtime_error     if a contact has no middle face, since its corners are at one
///         place or no numbers any more
void step(SolidState& s, const StepOptions& options);

/// Do what show_places() does, and sum the forces on the nodes of rigid grains with those of contacts
/// and pairs to SolidPlan::shown_forces. This writes nothing that a step reads.
void show_nodes(SolidState& s);

}  // namespace flexpm
