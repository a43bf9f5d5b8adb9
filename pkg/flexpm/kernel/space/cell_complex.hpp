// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Polyhedral cells that share faces and vertices by number, while they are being made.
/// Lengths in any one unit.
#pragma once

#include <flexpm/kernel/core/space_vector.hpp>

#include <array>
#include <limits>
#include <vector>

namespace flexpm {

/// Polygon between two cells, or between a cell and the outside.
struct CellFace {
    int first;                 ///< cell
    int second;                ///< cell on the other side, or -1
    int wall;                  ///< wall it lies on, or -1
    std::vector<int> corners;  ///< vertices, counter-clockwise as seen from outside `first`
    int joint = -1;            ///< joint it lies on, or -1
};

/// Points p with dot(normal, p) = offset.
struct WallPlane {
    Vector normal;  ///< of length 1
    double offset = 0.0;
};

/// Cells as their faces: each edge of a cell is in two of its faces.
struct CellComplex {
    int cells = 0;
    std::vector<Vector> vertices;
    std::vector<std::vector<int>> walls;  ///< per vertex, those it lies on, in order
    std::vector<CellFace> faces;
    int flanks = std::numeric_limits<int>::max();  ///< walls from this one on are of notches
    int first_joint = 0;                           ///< wall that is the plane of joint 0
    std::vector<WallPlane> planes = {};            ///< of each wall, of cells with joints or holes
    bool has_holes = false;
};

/// Whether each of the walls `some` is one of `all`; both in order.
bool is_subset(const std::vector<int>& some, const std::vector<int>& all);

/// Area of a polygon times the unit vector towards which it is counter-clockwise. A bent polygon
/// has that of any surface on its rim.
Vector area_vector(const CellComplex& complex, const std::vector<int>& corners);

/// Volume of each cell, exact for bent faces in the sense that shared faces cancel.
std::vector<double> cell_volumes(const CellComplex& complex);

/// Centroid of each cell; for a cell without volume its origin.
///
/// @param origins  per cell, a point near it, so that no digits are lost
/// @param volumes  see cell_volumes()
std::vector<Vector> cell_centroids(const CellComplex& complex, const std::vector<Vector>& origins,
    const std::vector<double>& volumes);

/// Number of faces between two cells.
int count_contacts(const CellComplex& complex);

/// Make vertices one that an edge shorter than `distance` joins, and cut away faces narrower than
/// it and vertices in which only two edges are left. Vertices stay on all their walls and keep
/// their places.
void merge_close_vertices(CellComplex& complex, double distance);

}  // namespace flexpm
