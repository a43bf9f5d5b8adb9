// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Where plates in soft machines, or on seats, are at the end of a step. SI units.
/// Deviation D95: spring and seat have no mass. A plate comes to where the spring of its machine
/// bears what its contacts do, and its seat no moment; its crosshead is there already.
#pragma once

#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/parts/plate_springs.hpp>

namespace flexpm {

/// The part of a shear force that friction bears [N].
double within_friction(const Plate& plate, double normal_force, double shear);

/// Bring a plate there at the end of a step that began at the present displacements of the nodes.
/// @return  what it has gone against its normal [m]
double give_way(const Assembly& a, Plate& plate, double dt);

/// Bring all plates there at the end of a step that begins at the present places of the grains.
void give_way(SolidState& s, double dt);

/// What the gap of point `index` grows by as its plate follows, see PlateStiffness::add().
/// @param give  part of a give [-]
Vector opens(const Plate& plate, int index, double give);

/// Turn on a seat of a plate's motion, which are a give and angles about seat_axes() [rad].
Vector turn_of(const Plate& plate, Vector motion);

/// How a plate of a solid follows what it touches, in a second.
struct PlateRates {
    double give = 0.0;  ///< what the spring of its machine becomes shorter by [m/s]
    Vector turn;        ///< on its seat [rad/s]
};

/// Those of a plate as grains move.
/// @param velocity  of all nodes [m/s]
PlateRates rates_of(const SolidState& s, const Plate& plate, const Array<double>& velocity);

}  // namespace flexpm
