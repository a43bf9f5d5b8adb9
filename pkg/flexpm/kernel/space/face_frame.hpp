// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Frame of a contact between two faces, and the forces that its turning asks for. SI units.
/// Deviation D66: the normal is that of the face in the middle between both, not of the centres.
#pragma once

#include <flexpm/kernel/core/space_vector.hpp>

#include <array>
#include <vector>

namespace flexpm {

/// Frame that opening and slip of a contact refer to: that of its middle face, whose corners lie in
/// the middle between those of both sides. It turns with the mean of both faces and is the same
/// seen from either.
struct FaceFrame {
    Vector normal;         ///< unit vector from a to b
    Vector first, second;  ///< tangents, right-handed with the normal
    double area;           ///< length of the area vector of the middle face [m^2]
    double span;           ///< of the line that the first tangent follows, in the face [m]
    double lean;           ///< of the line across the face [m]
};

/// Two corners that are farthest apart, the lower number first: the first tangent follows the line
/// between them.
std::array<int, 2> farthest_corners(const std::vector<Vector>& corners);

/// Frame of a middle face.
/// @param middle  its corners at present, counter-clockwise as seen from b
/// @param line    farthest_corners() of the bonded face
/// @throws std::invalid_argument  if the face has no area: the two sides have turned away from each
///                                other
FaceFrame face_frame(const std::vector<Vector>& middle, std::array<int, 2> line);

/// Forces on the corners of the middle face whose work is minus that of a couple on the frame.
///
/// A traction f on a point whose places on both sides are `jump` apart does the work f . (change of
/// jump) and, since opening and slip are taken along the turning frame, that of the couple f x jump
/// on it. With these forces, half of them on either side, a contact leaves no moment and its work
/// is that of its law, wherever its points have gone (deviation D66).
///
/// @param couple  sum of f x jump over the points [N m]
/// @return        per corner [N]; their sum is zero, their moment minus the couple
std::vector<Vector> couple_forces(const FaceFrame& frame, const std::vector<Vector>& middle,
    std::array<int, 2> line, Vector couple);

}  // namespace flexpm
