// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Plates laid against a part of the outline: supports and jaws. SI units.
#pragma once

#include <flexpm/kernel/parts/plate_lay.hpp>

namespace flexpm {

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
int find_patch_plate(const Assembly& a, const Patch& patch, const PlateContact& contact);
int find_jaw_plate(const Assembly& a, const Jaw& jaw, const PlateContact& contact);

}  // namespace flexpm
