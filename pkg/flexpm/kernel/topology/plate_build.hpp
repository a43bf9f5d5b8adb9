// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Plates laid against the outline of a specimen, paper Sec. 4.1. SI units.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

#include <vector>

namespace flexpm {

/// How a plate touches the grains.
struct PlateContact {
    double stiffness = 0.0;  ///< K_n [Pa/m]; 0: that of the first contact law
    double friction = 0.0;   ///< [-]; the shear stiffness has the ratio of the first contact law
    bool bonded = false;     ///< also pulls
    double strip = 0.0;      ///< of a layer between, in series with it [Pa/m]; 0: none
    bool seated = false;     ///< turns about the middle of its face, as on a spherical seat
};

/// Lay plates on a straight side of the outline, side by side and of equal width: one for a platen,
/// several for a membrane. An edge belongs to the plate that its middle lies on.
/// Returns the numbers of the new plates. Masses must be scaled again afterwards.
/// @throws std::invalid_argument  if the side has no edges, a plate or held nodes lie there, or a
///         value is out of range
std::vector<int> add_side_plates(Assembly& a, int side, int pieces, const PlateContact& contact);

/// Lay a plate against the specimen from outside, `normal` pointing inwards: it touches the
/// outermost point; edges that face it may come into contact. Returns its number.
int add_touching_plate(Assembly& a, Point normal, const PlateContact& contact);

/// A part of the outline, for a plate.
struct Patch {
    Point place;          ///< middle of the part, on or near the outline [m]
    double length = 0.0;  ///< along the plate [m]
    Point normal;         ///< into the specimen; zero: that of the nearest edge
};

/// Lay a plate against a part of the outline: a support, a roller, a platen that is narrower than
/// the side. It touches the outermost point of the part. An edge that lies on the part in part has
/// that part of its area, divided between its ends so that an even pressure acts at the middle of
/// the part. Returns its number; masses must be scaled again.
/// @throws std::invalid_argument  if no edge of the outline faces the part, the place is off it,
///                                the plate is longer than its side, a plate or held nodes lie
///                                there, or a value is out of range
int add_patch_plate(Assembly& a, const Patch& patch, const PlateContact& contact);

/// An arc around a part of a disc.
struct Jaw {
    Point place;          ///< on the rim of the disc, where the jaw's middle touches it [m]
    Point centre;         ///< of the disc [m]
    double radius = 0.0;  ///< of the arc, at least that of the disc [m]
    double angle = 0.0;   ///< of the disc before it, symmetrical about `place` [rad]
};

/// Lay a jaw against a disc. Gaps and normals are those of two circles, whatever chords the rim is
/// made of; a jaw of the disc's own radius touches all of its angle. Edges take part as those of
/// add_patch_plate(). Returns its number; masses must be scaled again. Deviation D95.
/// @throws std::invalid_argument  if the radius is below the disc's, the angle is not above 0 or
///                                beyond 120 degrees, no edge lies before it, a plate or held nodes
///                                lie there, or the contact is bonded
int add_jaw_plate(Assembly& a, const Jaw& jaw, const PlateContact& contact);

/// Number of the plate that these would lay, if it has been laid before; -1 if not. A stiffness of
/// its own is not looked at.
/// @throws std::invalid_argument  as they do
int find_side_plate(const Assembly& a, int side, const PlateContact& contact);
int find_patch_plate(const Assembly& a, const Patch& patch, const PlateContact& contact);
int find_jaw_plate(const Assembly& a, const Jaw& jaw, const PlateContact& contact);

/// Keep the first point that the plate touches from sliding along it: the node of a deformable
/// grain, or the centre of a rigid one. A disc that stands on single points would roll.
void fix_tangential(Assembly& a, int plate);

/// Lay a plate through `position`, apart from the specimen, that any grain may come to touch: its
/// corners do. All edges of all grains become boundary edges for it. Returns its number.
/// @throws std::invalid_argument  if it cuts a grain
int add_wall(Assembly& a, Point position, Point normal, const PlateContact& contact);

}  // namespace flexpm
