// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  How a step is done, in 2D and 3D.
#pragma once

namespace flexpm {

struct OuterForces;

struct StepOptions {
    double dt = 1.0;                     ///< time step [s]; 1 with scaled masses
    double damping = 0.7;                ///< alpha of Eq. 2 [-], 0 <= alpha < 1
    int threads = 1;                     ///< results do not depend on it
    bool measure = false;                ///< also sum kinetic energy and largest unbalanced force
    bool leave_nodes = false;            ///< of rigid grains in 3D, see show_nodes(); for speed
    const OuterForces* outer = nullptr;  ///< that act in this step, if any do
};

}  // namespace flexpm
