// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Preload of a test along its elastic solution, paper Sec. 4.1: no crack is possible before
/// the first contact point reaches its strength, so no slow steps are needed up to there.
///
/// All nodes are driven along the elastic solution in a few steps and then released with its
/// velocities. The contacts' history, the works and the energies are those of these steps. SI
/// units, tension positive.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

namespace flexpm {

/// Take hold of all nodes of an unloaded, gripped and driven rectangle, so that `steps` steps take
/// it along its elastic solution to `share` of the strain at which the first point leaves its
/// branch.
///
/// @throws std::invalid_argument  if the share or the number of steps is out of range, or if no
///         load breaks a point
void preload(Assembly& a, double share, int steps, double dt);

/// Release the nodes; the top goes on at `velocity` [m/s], all others as the elastic solution
/// does. The kinetic energy that this gives is work of the boundary.
///
/// @param undamped  as for start_elastically()
void release_preload(Assembly& a, double velocity, double dt, bool undamped);

}  // namespace flexpm
