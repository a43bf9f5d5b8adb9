// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Polygons cut into triangles, and the tetrahedra that join them to the centre of a grain.
#pragma once

#include <flexpm/kernel/core/space_vector.hpp>

#include <array>
#include <vector>

namespace flexpm {

/// Three vertices, in the sense of the polygon they are cut from.
using FaceTriangle = std::array<int, 3>;

/// Cut a polygon from the corner whose worst triangle is best: height over longest edge. If corners
/// on straight edges leave no such fan, other triangles are as good as can be. Both grains of a
/// contact use the same cut.
std::vector<FaceTriangle> face_triangles(
    const std::vector<Vector>& vertices, const std::vector<int>& corners);

/// Let a polygon begin at a corner from which face_triangles() cuts it, the same one as where its
/// corners run the other way around: both sides of a notch then have the same triangles.
void begin_alike(const std::vector<Vector>& vertices, std::vector<int>& corners);

/// Six times the volume of the tetrahedron of a centre and a triangle that is counter-clockwise as
/// seen from the other side.
inline double six_volumes(Vector centre, Vector a, Vector b, Vector c)
{
    return triple(a - centre, b - centre, c - centre);
}

/// Cosine of the smallest angle between two sides of the tetrahedron; 2 if it has no volume or is
/// turned.
double sharpest_cosine(Vector centre, Vector a, Vector b, Vector c);

}  // namespace flexpm
