// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Plates against the boundary edges of grains: one-point contacts, their forces, work and
/// energy, paper Sec. 4.1. SI units; openings are positive, forces of a plate on the specimen are
/// positive along its normal.
/// Deviation D20: a plate's contact has the stiffness K_n of the grains' contacts times its tributary
/// length times the thickness.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

#include <vector>

namespace flexpm {

/// How a plate touches the grains.
struct PlateContact {
    double stiffness = 0.0;  ///< K_n [Pa/m]; 0: that of the first contact law
    double friction = 0.0;   ///< [-]; the shear stiffness has the ratio of the first contact law
    bool bonded = false;     ///< also pulls
};

/// Lay plates on a straight side of the outline, side by side and of equal width: one for a platen,
/// several for a membrane. An edge belongs to the plate that its middle lies on.
/// Returns the numbers of the new plates. Masses must be scaled again afterwards.
/// @throws std::invalid_argument  if the side has no edges, or a value is out of range
std::vector<int> add_side_plates(Assembly& a, int side, int pieces, const PlateContact& contact);

/// Lay a plate against the specimen from outside, `normal` pointing inwards: it touches the
/// outermost point; edges that face it may come into contact. Returns its number.
int add_touching_plate(Assembly& a, Point normal, const PlateContact& contact);

/// Keep the first point that the plate touches from sliding along it: the node of a deformable grain, or
/// the centre of a rigid one. A disc that stands on single points would roll.
void hold_sideways(Assembly& a, int plate);

/// Lay a plate through `position`, apart from the specimen, that any grain may come to touch: its
/// corners do. All edges of all grains become boundary edges for it. Returns its number.
/// @throws std::invalid_argument  if it cuts a grain
int add_wall(Assembly& a, Point position, Point normal, const PlateContact& contact);

/// Let a plate move along its normal under a pressure [Pa] on its width instead of a given velocity.
void press(Assembly& a, int plate, double pressure);

/// Prescribe a plate's velocity [m/s].
void set_velocity(Assembly& a, int plate, Point velocity);

/// Move the plates over a step `dt`, update their forces on the grains, and integrate the loaded
/// ones. Called by step() between contacts and grains.
void update_plates(Assembly& a, double dt, double damping);

/// One-point contact of a plate, for sums.
struct PlatePoint {
    int edge;                ///< boundary edge
    double weight;           ///< of the edge's second node [-]
    double stiffness;        ///< normal [N/m]
    double shear_stiffness;  ///< [N/m], 0 if smooth
};
PlatePoint plate_point(const Plate& p, int index);
int plate_points(const Plate& p);

/// Stored energy of a plate's contacts [J].
double elastic_energy(const Plate& p);

/// Force of the plates of a side on the specimen [N].
Point plate_force(const Assembly& a, int side);
bool has_plates(const Assembly& a, int side);

/// Length along the plate between its outermost points in contact, each with its tributary length [m];
/// 0 if nothing touches.
double contact_width(const Assembly& a, int plate);

}  // namespace flexpm
