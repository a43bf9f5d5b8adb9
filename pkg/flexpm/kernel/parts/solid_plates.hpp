// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Plates against the surface triangles of a specimen in 3D. A contact lies in the middle of
/// each triangle, or where its shares say. SI units; forces of a plate on the specimen are positive
/// along its normal, which points into it.
/// Deviation D20: it has the stiffness K_n of the grains' contacts times the triangle's area, and
/// along the plate, if that is not smooth, K_s.
#pragma once

#include <flexpm/kernel/assembly/solid_state.hpp>
#include <flexpm/kernel/parts/plate_loading.hpp>
#include <flexpm/kernel/parts/plate_points.hpp>
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

/// A smooth plate for a side, with the stiffnesses of the grains' contacts, that touches nothing.
Plate plain_plate(const SolidState& s, SolidSide side);

/// Number of the first plate on a side; -1 if there is none.
inline int find_plate(const SolidState& s, SolidSide side)
{
    return find_plate(s, static_cast<int>(side));
}

/// Add the forces of plates on the nodes of a block of grains, at their present places.
void add_plate_forces(SolidState& s, int block);

/// Sum forces and works of all plates after the grains have moved by a step, and integrate the
/// loaded ones.
void sum_plates(SolidState& s, double dt, double damping);

}  // namespace flexpm
