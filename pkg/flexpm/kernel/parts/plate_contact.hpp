// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Plates against the facets of the boundary: one-point contacts, their forces, work and
/// energy, paper Sec. 4.1. SI units; openings are positive, forces of a plate on the specimen are
/// positive along its normal.
/// Deviation D20: a plate's contact has the stiffness K_n of the grains' contacts times its
/// tributary length times the thickness.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>
#include <flexpm/kernel/parts/plate_loading.hpp>
#include <flexpm/kernel/parts/plate_points.hpp>

namespace flexpm {

/// Move the plates over a step `dt`, update their forces on the grains, and integrate the loaded
/// ones. Called by step() between contacts and grains.
void update_plates(Assembly& a, double dt, double damping);

/// Point of a plate on an edge, for sums.
struct EdgePoint {
    int facet;
    double weight;           ///< of the facet's second node, see facet_parts() [-]
    double stiffness;        ///< normal [N/m]
    double shear_stiffness;  ///< [N/m], 0 if smooth
};
EdgePoint edge_point(const Plate& p, int index);

/// Middle of what a plate lies on, when bonded [m].
Point middle_of_face(const Assembly& a, const Plate& p);

/// Length along the plate between its outermost points in contact, each with its tributary length
/// [m]; 0 if nothing touches.
double contact_width(const Assembly& a, int plate);

/// Angle of the disc over which it lies against a jaw, with the same ends [rad].
double contact_angle(const Assembly& a, int plate);

}  // namespace flexpm
