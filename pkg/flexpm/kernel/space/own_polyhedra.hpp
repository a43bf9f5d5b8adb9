// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Polyhedral cells that were given, not cut from spheres (deviation D97).
#pragma once

#include <flexpm/kernel/space/polyhedra.hpp>

#include <vector>

namespace flexpm {

/// Polygon of given cells.
struct OwnFace {
    int first;                 ///< its corners are counter-clockwise as seen from outside this cell
    int second;                ///< larger than `first`, or -1 on the outside
    std::vector<int> corners;  ///< vertices
};

/// Given cells over shared vertices.
struct OwnCells {
    std::vector<Vector> vertices;  ///< [m]
    std::vector<OwnFace> faces;
    std::vector<Sphere> spheres;  ///< per cell its centre, well inside, and the size of the cell
    std::vector<int> pores = {};  ///< cells that are taken out in the end, in order
    std::vector<JointPlane> joints = {};  ///< cut in this order; cut cells get their centroids
    std::vector<Hole> holes = {};         ///< cut after the joints
};

/// Convex cells that fill a solid, short edges collapsed as those of spheres are. Messages count
/// cells and faces from 1, as files of cells do.
///
/// Places are right to 1e-6 mean diameters of the spheres: faces are as plane as that, cells as
/// convex, and outer faces lie on a wall.
///
/// Pores are cells of the solid until short edges are collapsed. Then they are taken out, and the
/// others are numbered without them. The walls of a pore are flanks, as those of a notch, with the
/// number of walls of the solid as their wall.
///
/// @throws std::invalid_argument  for a number out of range, cells that are not closed, not convex
///                                or without volume, bent faces, two faces between two cells, an
///                                outer face on no wall, cells that do not fill the solid, and
///                                pores that are no cells, out of order, or all of the cells
Polyhedra own_polyhedra(const OwnCells& own, const Solid& solid, double short_edge);

}  // namespace flexpm
