// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Corners of a convex body that deforms a little: which planes meet in them is found once, and
/// where they are is then cheap. SI units.
#pragma once

#include <flexpm/kernel/assembly/pair_plan.hpp>

namespace flexpm {

/// Corners of the body behind some planes, with those that appear if planes move by up to 0.002 of the
/// size of the body, and turn by as much. Their order is that of the planes.
std::vector<BodyCorner> corners_behind(const std::vector<ContactPlane>& planes);

/// Positions of the corners that the planes have now. Where more than three planes meet a position
/// occurs several times.
void place_corners(const std::vector<ContactPlane>& planes, const std::vector<BodyCorner>& corners,
    std::vector<Vector>& positions);

}  // namespace flexpm
