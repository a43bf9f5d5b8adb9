// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Plates on the ends of a specimen in space, and against the mantle of a disc:
/// plate_contact.hpp there. A contact lies in the middle of each surface triangle, or where its
/// shares say. SI units; forces of a plate on the specimen are positive along its normal, which
/// points into it.
/// Deviation D20: it has the stiffness K_n of the grains' contacts times the triangle's area, and
/// along the plate, if that is not smooth, K_s.
/// Deviation D95: the spring of a soft machine has no mass, and a plate before one is where spring
/// and contacts balance; on a seat it turns until they bear no moment.
#pragma once

#include <flexpm/kernel/assembly/solid_state.hpp>
#include <flexpm/kernel/space/solid.hpp>

#include <array>

namespace flexpm {

/// Mean of a vector over a triangle.
Vector middle(const Array<double>& values, const std::array<int, 3>& nodes);

/// Let a plate touch a whole triangle, in its middle.
void add_contact(const SolidState& s, Plate& plate, int triangle);

/// Lay a smooth plate on the bottom or the top. Masses must be scaled again afterwards.
/// @param bonded  it pulls as well as it presses
/// @throws std::invalid_argument  for another side, or one without triangles or with a plate
void add_end_plate(SolidState& s, SolidSide side, bool bonded);

/// Let grains stick to the plates from their present places on, as far as friction bears it.
/// @param friction  coefficient [-]
/// @throws std::invalid_argument  if it is below 0, or there are no two plates that press
void roughen_plates(SolidState& s, double friction);

/// Friction of a plate that does not slide while it presses [-].
constexpr double no_sliding = 1e6;

/// Let a plate that has all of its contacts bear friction.
/// @param friction  coefficient [-]
void roughen(Plate& plate, double friction);

/// Lay a soft layer on a plate's face, in series with its contacts along its normals.
/// @param strip  its stiffness per area [Pa/m]; 0: there is none
void lay_strip(Plate& plate, double strip);

/// Lay a plate that has all of its contacts; returns its number.
int add_plate(SolidState& s, const Plate& plate);

/// Move the position of a plate that has all of its contacts along its face to where its load acts:
/// the mean of the contacts by area.
void centre_position(const SolidState& s, Plate& plate);

/// Let plates hold what touches them now, pulled or pressed, and along the face if they have
/// friction: as linear solutions have it. What does not touch them never does.
void hold_touching(SolidState& s);

/// Number of the plate that was laid as this one; -1 if there is none.
int find_alike(const SolidState& s, const Plate& plate);

/// A smooth plate for a side, with the stiffnesses of the grains' contacts, that touches nothing.
Plate plain_plate(const SolidState& s, SolidSide side);

/// Number of the first plate on a side; -1 if there is none.
int find_plate(const SolidState& s, SolidSide side);

/// Contact `index` of a plate along its normal [N/m].
double point_stiffness(const Plate& plate, int index);
/// The same along its face; 0: it is smooth [N/m].
double sliding_stiffness(const Plate& plate, int index);

/// Normal of contact `index`, into the specimen; of a jaw its own.
Vector normal_at(const Plate& plate, int index);

/// Add the forces of plates on the nodes of a block of grains, at their present places.
void add_plate_forces(SolidState& s, int block);

/// Let a load move a plate along its normal. Masses must be scaled again afterwards.
/// @throws std::invalid_argument  if there is no such plate, or it is one of a line or a jaw
void free_plate(SolidState& s, int plate);

/// Let a pressure act on a plate that is free to move along its normal, see Plate::loaded [Pa].
/// @throws std::invalid_argument  if there is no such plate, its mass is not scaled, or for a
///         pressure below 0
void press(SolidState& s, int plate, double pressure);

/// Lay the spring of a soft machine behind a plate [N/m]. It has the plate's present force and
/// gives way along the plate's normal; while a load moves the plate it follows from that.
/// @throws std::invalid_argument  if there is no such plate, the stiffness is not above 0, the
///         plate has another spring, or it is a jaw with friction
void set_machine(SolidState& s, int plate, double stiffness);

/// Bring plates to where the springs of their machines bear what their contacts do, and their seats
/// no moment, at the end of a step that begins at the present places of the grains; crossheads are
/// there already.
void give_way(SolidState& s, double dt);

/// How a plate follows what it touches, in a second.
struct PlateRates {
    double give = 0.0;  ///< what the spring of its machine becomes shorter by [m/s]
    Vector turn;        ///< on its seat [rad/s]
};

/// Those of a plate as grains move.
/// @param velocity  of all nodes [m/s]
PlateRates rates_of(const SolidState& s, const Plate& plate, const Array<double>& velocity);

/// Sum forces and works of all plates after the grains have moved by a step, and integrate the
/// loaded ones.
void sum_plates(SolidState& s, double dt, double damping);

/// What a seated plate's face goes along its normal at contact `index` by each component of a turn
/// [m]; nought without a seat.
Vector seat_arm(const Plate& plate, int index);

/// What the gap of contact `index` grows by as its plate follows, see PlateStiffness::add().
/// @param give  part of a give [-]
Vector opens(const Plate& plate, int index, double give);

/// Turn on a seat of a plate's motion, which are a give and angles about seat_axes() [rad].
Vector turn_of(const Plate& plate, Vector motion);

/// Area on which a plate presses [m^2].
double pressed_area(const Plate& plate);

/// Stored energy of a plate's contacts [J].
double solid_plate_energy(const Plate& plate);

}  // namespace flexpm
