// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Preload of a test along its elastic solution, paper Sec. 4.1: no crack is possible before
/// the first contact point reaches its strength, so no slow steps are needed up to there.
///
/// All grains are driven along the elastic solution in a few steps and then released with its
/// velocities. The contacts' history, the works and the energies are those of these steps. SI
/// units, tension positive.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>
#include <flexpm/kernel/laboratory/solid_drive.hpp>

#include <vector>

namespace flexpm {

struct PreloadPath {
    double share;  ///< of the load at which the first point leaves its elastic branch [-]
    int steps;     ///< that lead there
    double dt;     ///< time step [s]
};

/// Take hold of all nodes of an unloaded, gripped and driven rectangle, so that the steps take it
/// along its elastic solution to that share.
///
/// @returns  components that were held before, for release_preload()
/// @throws std::invalid_argument  if the share or the number of steps is out of range, or if no
///         load breaks a point
std::vector<int> preload(Assembly& a, const PreloadPath& path);

/// The same of a 3D specimen between its ends, from where pressures have brought it: of rigid
/// grains with their spins. The share is that of the load that is left.
///
/// @param field  of the strain 1 for this drive, see elastic_field()
/// @param sense  -1: compression
/// @throws std::invalid_argument  also if a point has left its elastic branch, or parts are free to
///         move
std::vector<int> preload(SolidState& s, const SolidDrive& drive, const SolidField& field,
    double sense, const PreloadPath& path);

/// Release the nodes; the top goes on at `velocity` [m/s], all others as the elastic solution
/// does. The kinetic energy that this gives is work of the boundary.
///
/// @param held      by preload()
/// @param undamped  as for start_elastically() and start()
/// @throws std::invalid_argument  unless the velocity is finite and the specimen moves along its
///         elastic solution
void release_preload(
    Assembly& a, const std::vector<int>& held, double velocity, double dt, bool undamped);
void release_preload(SolidState& s, const SolidDrive& drive, const std::vector<int>& held,
    double velocity, double dt, bool undamped);

}  // namespace flexpm
