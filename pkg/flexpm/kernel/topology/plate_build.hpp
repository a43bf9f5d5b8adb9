// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Plates laid against sides of a specimen or apart from it, paper Sec. 4.1. SI units.
#pragma once

#include <flexpm/kernel/parts/plate_lay.hpp>

#include <vector>

namespace flexpm {

/// Lay plates on a straight side of the outline, side by side and of equal width: one for a platen,
/// several for a membrane. An edge belongs to the plate that its middle lies on.
/// Returns the numbers of the new plates. Masses must be scaled again afterwards.
/// @throws std::invalid_argument  if the side has no edges, a plate or held nodes lie there, or a
///         value is out of range
std::vector<int> add_side_plates(Assembly& a, int side, int pieces, const PlateContact& contact);

/// Lay a plate against the specimen from outside, `normal` pointing inwards: it touches the
/// outermost point; edges that face it may come into contact. Returns its number.
int add_touching_plate(Assembly& a, Point normal, const PlateContact& contact);

/// Number of the plate that add_side_plates() would lay, if it has been laid before; -1 if not. A
/// stiffness of its own is not looked at.
/// @throws std::invalid_argument  as it does
int find_side_plate(const Assembly& a, int side, const PlateContact& contact);

/// Keep the first point that the plate touches from sliding along it: the node of a deformable
/// grain, or the centre of a rigid one. A disc that stands on single points would roll.
void fix_tangential(Assembly& a, int plate);

/// Lay a plate through `position`, apart from the specimen, that any grain may come to touch: its
/// corners do. All edges of all grains become boundary edges for it. Returns its number.
/// @throws std::invalid_argument  if it cuts a grain
int add_wall(Assembly& a, Point position, Point normal, const PlateContact& contact);

}  // namespace flexpm
