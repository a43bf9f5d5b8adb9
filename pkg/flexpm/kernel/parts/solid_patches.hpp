// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Plates laid against a part of a solid's outside: supports, rollers and platens, on a seat
/// or not. SI units.
#pragma once

#include <flexpm/kernel/assembly/solid_state.hpp>

namespace flexpm {

/// Part of the outside that lies in a box and faces a plate.
struct SolidPatch {
    Vector normal;          ///< into the specimen, along an axis
    Vector low, high;       ///< corners of the box [m]
    double friction = 0.0;  ///< coefficient [-]; 0: smooth
    bool bonded = false;
    double strip = 0.0;   ///< of a soft layer between, in series [Pa/m]; 0: none
    bool seated = false;  ///< turns about the middle of its face, as on a spherical seat
};

/// Lay a plate on a patch. It turns on a seat alone. A surface triangle that leaves the box is
/// touched where what is within has its middle. Masses must be scaled again afterwards.
/// @return  number of the plate
/// @throws std::invalid_argument  for a normal that is no unit vector, a friction below 0, one of a
///                                bonded plate, if nothing faces the plate there, or one on a seat
///                                touches in a line
int add_patch_plate(SolidState& s, const SolidPatch& patch);

/// Lay a plate through a position, apart from the specimen, that all of its surface may come to
/// touch: with the corners of the surface triangles, each of which has a third of its triangle.
/// Masses must be scaled again afterwards.
/// @param normal    from the plate to the specimen, of any length
/// @param friction  coefficient [-]; 0: smooth
/// @return  number of the plate
/// @throws std::invalid_argument  if it cuts a grain, the normal has no length, or the friction is
///                                below 0
int add_wall(SolidState& s, Vector position, Vector normal, double friction);

/// Number of the plate that add_patch_plate() has laid on a patch; -1 if there is none.
int find_patch_plate(const SolidState& s, const SolidPatch& patch);

}  // namespace flexpm
