// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Bound of the nodal stiffness, scaled and real masses of a specimen in 3D, of tetrahedra and
/// faces, deviation D4.
#pragma once

#include <flexpm/kernel/assembly/solid_state.hpp>

namespace flexpm {

/// Upper bounds K_t of the stiffness: row sums of the norms of the 3x3 blocks of a grain's
/// tetrahedra, and of the points of its faces, intact. Turns of rigid grains count as the radius
/// times the angle.
struct SolidBound {
    Array<double> node;        ///< Layout::scalar_index [N/m]; of a rigid grain at the centre
    std::vector<double> turn;  ///< of rigid grains [N m]
};
SolidBound stiffness_bound(const SolidState& s);

/// Masses for the time step `dt`: m = mass_margin (1 + alpha) K_t dt^2 / 4.
/// @throws std::invalid_argument  if not 0 <= damping < 1 or dt <= 0
void scale_masses(SolidState& s, double damping, double dt = 1.0);

/// Let masses rise where pairs of grains without a common face press on more area than before, with
/// 25 % to spare.
/// @param damping, dt  as of scale_masses(); dt = 0 leaves the masses alone (real masses), and
///                     stable_step() falls
/// @return             whether any pair has grown
bool bear_pairs(SolidState& s, double damping, double dt);

/// Mass of a grain as a whole, and its inertia about its centre in the axes of the reference.
struct SolidMass {
    double mass = 0.0;       ///< [kg]
    SpaceTensor inertia {};  ///< [kg m^2]
};
SolidMass real_mass(const SolidState& s, int grain);

/// A quarter of the mass of each tetrahedron to each of its nodes; of a rigid grain all to the
/// centre, and the moments of inertia about it.
void set_real_masses(SolidState& s);

/// The same; masses of loaded plates are scaled. Returns stable_step().
/// @throws std::invalid_argument  if not 0 <= damping < 1
double set_real_masses(SolidState& s, double damping);

/// Time step that keeps the present masses stable [s].
/// @throws std::invalid_argument  if not 0 <= damping < 1
double stable_step(const SolidState& s, double damping);

}  // namespace flexpm
