// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Where a plate in a soft machine, or on a seat, is at the end of a step. SI units.
/// Deviation D95: spring and seat have no mass.
#pragma once

#include <flexpm/kernel/parts/plate_contact.hpp>

namespace flexpm {

/// Force that a point of a plate has at a gap [N].
double normal_force(const Plate& plate, const PlatePoint& p, double gap);

/// The part of a shear force that friction bears [N].
double within_friction(const Plate& plate, double normal_force, double shear);

/// Bring a plate to where the spring of its machine bears what its contacts do, and its seat no
/// moment, at the end of a step that began at the present displacements of the nodes.
///
/// @return  what it has gone against its normal [m]
double give_way(const Assembly& a, Plate& plate, double dt);

}  // namespace flexpm
