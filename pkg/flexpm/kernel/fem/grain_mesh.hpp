// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Finite element mesh inside each grain, paper Sec. 2.2, Fig. 1 and 4(c).
#pragma once

#include <flexpm/kernel/fem/mesh_template.hpp>
#include <flexpm/kernel/geometry/cells.hpp>

#include <vector>

namespace flexpm {

/// Smallest angle of a template's triangle [rad]; 10 degrees. Below it the grain's mesh is changed.
constexpr double smallest_template_angle = 0.17453292519943295;

/// Mesh of one grain. Node k < V lies on corner (first_vertex + k) mod V of the cell; node V is the
/// centre, the disc centre unless `moved_centre`.
struct GrainMesh {
    int first_vertex = 0;
    std::vector<Point> nodes;         ///< [m]
    std::vector<Triangle> triangles;  ///< all of positive area
    bool standard = true;             ///< connectivity of mesh_template()
    bool fallback = false;            ///< fan, although refined was asked for
    bool moved_centre = false;        ///< the disc centre does not see every edge: centroid instead
    double smallest_angle = 0.0;      ///< of all triangles [rad]
};

/// Mesh of a polygon, corners counter-clockwise. The refined template merges its inner nodes at the
/// shortest edge; if a triangle is then inverted or below `smallest_template_angle`, at the edge
/// that gives the best angle; if that does not do, edges are flipped; if one stays inverted, a fan
/// is used.
///
/// @param centre  of the disc; it or the centroid of the polygon must see all its edges
/// @throws std::invalid_argument  if the polygon is star-shaped about neither
GrainMesh make_grain_mesh(const std::vector<Point>& polygon, Point centre, MeshKind kind);

/// Meshes of all cells.
std::vector<GrainMesh> make_grain_meshes(
    const Tessellation& tessellation, const std::vector<Disc>& discs, MeshKind kind);

/// Smallest angle of a triangulation [rad]; negative if a triangle is not counter-clockwise.
double smallest_angle(const std::vector<Point>& nodes, const std::vector<Triangle>& triangles);

/// Flip inner edges until none raises the smallest angle of its two triangles (Lawson).
/// The boundary of the mesh does not change.
void flip_edges(const std::vector<Point>& nodes, std::vector<Triangle>& triangles);

}  // namespace flexpm
