// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Bound of the nodal stiffness, scaled masses and stable time step, paper Sec. 2.4.
/// Deviation D4: Eq. 20 (m = K_t / 4) is unstable with the damping of Eq. 2, which lowers the limit
/// to omega dt < 2 / sqrt(1 + alpha); masses carry the factor s (1 + alpha).
/// Deviation D26: real masses of rigid grains are those of the cell, centred in the disc.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

namespace flexpm {

/// Margin s: at 1, nodes that no contact touches sit on the limit and grow.
constexpr double mass_margin = 1.1;

/// Upper bounds K_t of the stiffness: contacts by Eq. 21 with their full stiffness, so that
/// breaking never lowers it, and elements by the row sums of the norms of the 2x2 blocks of the
/// grain's stiffness. Rigid grains: row sums at the centre, rotations taken as the disc's radius
/// times the angle, with the coupling of translation and rotation.
struct StiffnessBound {
    Array<double> node;      ///< [block][node][lane] [N/m]; of a rigid grain at the centre
    Array<double> rotation;  ///< [block][lane] of rigid grains [N m]
};
StiffnessBound stiffness_bound(const Assembly& a);

/// The part of the elements in StiffnessBound::node, which changes only when a grain is taken out.
Array<double> element_bound(const Grains& grains);

/// @throws std::invalid_argument  if not 0 <= damping < 1
void check_damping(double damping);

/// Masses for the time step `dt`, m = s (1 + alpha) K_t dt^2 / 4, of nodes and loaded plates, and
/// moments of inertia of rigid grains by the same rule. Call it again after adding plates.
/// @throws std::invalid_argument  if not 0 <= damping < 1 or dt <= 0
void scale_masses(Assembly& a, double damping, double dt = 1.0);

/// Time step that keeps the present masses stable with the present contacts and plates [s].
double stable_step(const Assembly& a, double damping);

/// Mass of a grain as a whole: its cell, turning about the centroid.
struct GrainMass {
    double mass = 0.0;     ///< [kg]
    double inertia = 0.0;  ///< [kg m^2]
};
GrainMass real_mass(const Assembly& a, int grain);

/// Radius of a sphere that has the volume of a grain [m].
double equal_sphere(const Assembly& a, int grain);

/// Real masses: a third of each triangle's to its nodes; of a rigid grain those of the lamina of
/// its cell, as if its mass centre were the disc's. Plates' are scaled. Returns stable_step().
double set_real_masses(Assembly& a, double damping);

}  // namespace flexpm
