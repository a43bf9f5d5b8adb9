// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Plates against the facets of the boundary: one-point contacts, their forces, work and
/// energy, paper Sec. 4.1. SI units; openings are positive, forces of a plate on the specimen are
/// positive along its normal.
/// Deviation D20: a plate's contact has the stiffness K_n of the grains' contacts times its
/// tributary length times the thickness.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

namespace flexpm {

/// @throws std::invalid_argument  unless there is a plate of that number
void require_plate(const Assembly& a, int plate);

/// Let a plate move along its normal under a pressure [Pa] on its width instead of a given
/// velocity. It does not act while all of its grains are loose, which counts as a load that nothing
/// balances.
void press(Assembly& a, int plate, double pressure);

/// Prescribe a plate's velocity, or that of its crosshead [m/s].
void set_velocity(Assembly& a, int plate, Vector velocity);

/// Lay the spring of a soft machine behind a plate [N/m]. It has the plate's present force.
///
/// The spring and the plate have no mass: the plate is where the spring and its contacts balance,
/// at each step. It gives way along its normal alone. A plate under a load has no use of it.
/// Deviation D95.
/// @throws std::invalid_argument  if there is no such plate, the stiffness is not above 0, or the
///         plate has another spring
void set_machine(Assembly& a, int plate, double stiffness);

/// Move the plates over a step `dt`, update their forces on the grains, and integrate the loaded
/// ones. Called by step() between contacts and grains.
void update_plates(Assembly& a, double dt, double damping);

/// One-point contact of a plate, for sums.
struct PlatePoint {
    int facet;
    double weight;           ///< of the facet's second node, see facet_parts() [-]
    double stiffness;        ///< normal [N/m]
    double shear_stiffness;  ///< [N/m], 0 if smooth
};
PlatePoint plate_point(const Plate& p, int index);
int plate_points(const Plate& p);

/// Force of one of its points on the specimen at the last step [N].
Vector point_force(const Plate& p, int index);

/// Stored energy of a plate's contacts [J].
double elastic_energy(const Plate& p);

/// Force of the plates of a side on the specimen [N].
Vector plate_force(const Assembly& a, int side);
bool has_plates(const Assembly& a, int side);

/// Middle of what a plate lies on, when bonded [m].
Point middle_of_face(const Assembly& a, const Plate& p);

/// Length along the plate between its outermost points in contact, each with its tributary length
/// [m]; 0 if nothing touches.
double contact_width(const Assembly& a, int plate);

/// Angle of the disc over which it lies against a jaw, with the same ends [rad].
double contact_angle(const Assembly& a, int plate);

}  // namespace flexpm
