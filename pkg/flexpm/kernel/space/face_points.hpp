// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Points of a contact between two polyhedral grains, and their shares of its area. SI
/// units.
#pragma once

#include <flexpm/kernel/core/space_vector.hpp>

#include <vector>

namespace flexpm {

/// Where a face has its points. A rule is exact to degree 2 if force and both moments of a traction
/// that is linear over the face, and the stiffness against turning, are those of the whole face.
enum class FacePointRule {
    corners_and_inner,  ///< the corners and one free inner point: exact to degree 2
    one,                ///< the centroid: exact to degree 1, no stiffness against turning
    three,              ///< three of equal weight on sqrt(2) times the ellipse of inertia: degree 2
    four,               ///< four of equal weight there: degree 2
    corners,            ///< the corners: degree 1, second moments up to four times too large
};

/// A point of a face: a mean of the face's corners.
struct FacePoint {
    double area;                 ///< share of the face [m^2]
    std::vector<double> shares;  ///< per corner, with sum 1 [-]
};

/// Points of a face.
struct FacePoints {
    double area;    ///< of the face, projected [m^2]
    Vector normal;  ///< of the plane on which it is projected, of length 1
    /// Whether the rule has no points inside: corners + 1 equal ones, or corners and an inner one
    /// instead.
    bool fallback;
    std::vector<FacePoint> points;
};

/// Points of a polygon, by a rule. A bent one is projected on the plane normal to its area vector.
/// Places and weights are exact there; corners keep their own height, so that a point is where its
/// shares put it.
///
/// @param corners  counter-clockwise as seen from the tip of the normal [m]
/// @throws std::invalid_argument  for fewer than three corners, or no area
FacePoints face_points(const std::vector<Vector>& corners, FacePointRule rule);

/// Whether a polygon has space for its corners' points and an inner one, or equal ones instead.
bool has_points(const std::vector<Vector>& corners);

}  // namespace flexpm
