// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Faces and lines by which a window shows a solid, with a plane that lays its inside open.
/// SI units.
#pragma once

#include <flexpm/kernel/assembly/solid_state.hpp>

#include <array>
#include <vector>

namespace flexpm {

/// What lies where normal . place > offset is not drawn; without a normal all is.
struct CutPlane {
    Vector normal;
    double offset = 0.0;  ///< [m] for a normal of length 1

    /// How far a place lies beyond it [m].
    double beyond(Vector place) const { return dot(normal, place) - offset; }
    bool cuts() const { return dot(normal, normal) > 0.0; }
};

using Polygon = std::vector<Vector>;    ///< convex [m]
using Segment = std::array<Vector, 2>;  ///< [m]
using NodePair = std::array<int, 2>;    ///< offsets of nodes, the lower one first

/// What is left of a convex polygon in front of a plane; empty if nothing is.
Polygon in_front(const Polygon& polygon, const CutPlane& plane);

/// The same of a line; its ends are alike if nothing is left.
Segment in_front(const Segment& line, const CutPlane& plane);

/// The line in which a plane cuts a convex polygon; its ends are alike if it does not.
Segment cut_line(const Polygon& polygon, const CutPlane& plane);

/// Edges of the polyhedra, for each grain: between two contacts, a contact and a wall, or two
/// walls.
std::vector<std::vector<NodePair>> polyhedron_edges(const SolidState& s);

/// What is drawn of one grain.
struct GrainFaces {
    std::vector<Polygon> outside;  ///< triangles of the surface, in front of the plane
    std::vector<Polygon> section;  ///< where the plane cuts the tetrahedra, seen from beyond it
    std::vector<Segment> lines;    ///< edges in front of the plane, and the rim of the section
};

/// @param edges   of the grain, by polyhedron_edges()
/// @param factor  displacements are drawn this many times larger [-]
GrainFaces grain_faces(const SolidState& s, int grain, const std::vector<NodePair>& edges,
    double factor, const CutPlane& plane);

/// Part of a contact's middle face that a point stands for, where displacements are drawn `factor`
/// times larger: around a corner, or in the middle, as large as the point's area is of all. Points
/// that are no corners and more than one stand for the whole face.
std::vector<Polygon> point_part(const SolidState& s, int contact, int point, double factor);

/// Whether each node, by Layout::scalar_index, is on the surface of the specimen.
std::vector<bool> surface_nodes(const SolidState& s);

/// Halves of the edges at a point in a corner that lie in the surface of the specimen: where its
/// crack shows outside.
std::vector<Segment> point_rim(const SolidState& s, int contact, int point, double factor,
    const std::vector<bool>& on_surface);

}  // namespace flexpm
