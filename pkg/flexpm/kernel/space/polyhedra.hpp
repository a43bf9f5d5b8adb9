// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Polyhedral cells of a packing of spheres that fill a solid.
#pragma once

#include <flexpm/kernel/space/cell_complex.hpp>
#include <flexpm/kernel/space/joint_planes.hpp>
#include <flexpm/kernel/space/solid.hpp>

#include <limits>
#include <vector>

namespace flexpm {

/// Polygon between two cells, or of a cell on a wall.
struct PolyhedronFace {
    int cell_a;  ///< its corners are counter-clockwise as seen from outside this cell
    int cell_b;  ///< larger than `cell_a`, or -1 on a wall
    int wall;    ///< of the solid; on the flanks of notch i its number of walls and i;
                 ///< on hole i `first_hole` and i; -1: none
};

/// Cells over shared vertices. Faces between cells come first, in order of (cell_a, cell_b).
struct Polyhedra {
    std::vector<Vector> vertices;  ///< [m]
    std::vector<Vector> centres;   ///< per cell, common corner of its tetrahedra [m]
    std::vector<double> volumes;   ///< per cell [m^3]
    std::vector<PolyhedronFace> faces;
    std::vector<int> face_offsets;  ///< of each face in `face_vertices`, and the end
    std::vector<int> face_vertices;
    std::vector<int> joints;               ///< per contact, the joint that it lies on, or -1
    std::vector<JointOutcome> joint_cuts;  ///< outcome of each joint
    std::vector<HoleOutcome> hole_cuts;    ///< outcome of each hole
    int first_hole =
        std::numeric_limits<int>::max();  ///< wall of the first hole; other holes follow
    std::vector<int> sphere_of_cell;      ///< pieces of a cell that has been cut have one
    std::vector<int> hidden_spheres;      ///< without a cell
    std::vector<int>
        moved_centres;  ///< cells whose centre is their centroid: the sphere's is not well inside
    int contacts = 0;   ///< faces between cells
    int uncollapsed_contacts = 0;  ///< before short edges were collapsed
    int short_edges = 0;           ///< edges below the limit that had to stay

    int cells() const { return static_cast<int>(sphere_of_cell.size()); }
    std::vector<int> corners(int face) const
    {
        return { face_vertices.begin() + face_offsets[face],
            face_vertices.begin() + face_offsets[face + 1] };
    }
};

struct PolyhedraOptions {
    double short_edge = 0.0;    ///< edges below this length are collapsed [m]
    bool allow_hidden = false;  ///< drop spheres without a cell (counted) instead of refusing them
    std::vector<NotchPlane> notches = {};  ///< which do not meet in a cell
    std::vector<JointPlane> joints = {};   ///< cut in this order, before the notches
    std::vector<Hole> holes = {};          ///< cut after the joints
};

/// Cells of the spheres inside the solid, in the order of the spheres, short edges collapsed.
///
/// @throws std::invalid_argument  for no sphere, a number that is not finite, a radius <= 0, a
///                                centre outside or in the place of another; for short_edge < 0;
///                                for a hidden sphere unless allowed; for a cell without volume
Polyhedra polyhedra(
    const std::vector<Sphere>& spheres, const Solid& solid, const PolyhedraOptions& options);

/// Length over the mean diameter below which vertices are one.
constexpr double zero_edge = 1e-9;

/// Note the outcome of holes and their walls.
void set_holes(Polyhedra& p, const CutCells& cut, int first_wall);

/// Check a limit of edges.
/// @throws std::invalid_argument  unless finite and >= 0
void require_short_edge(double short_edge);

/// The rest of the way of any cells whose faces are known: short edges collapsed, cells numbered
/// without the hidden ones, whose faces become flanks of their neighbours, vertices in the order in which faces use them, volumes between the
/// triangles of the faces, which a collapse has bent.
///
/// @param p           knows its hidden spheres, in order
/// @param centres     per cell, hidden ones too, the common corner of its tetrahedra
/// @param short_edge  edges below this length are collapsed [m]
void finish_cells(
    Polyhedra& p, CellComplex& complex, const std::vector<Vector>& centres, double short_edge);

}  // namespace flexpm
