// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Cells cut by the walls of a solid, and by a notch.
#pragma once

#include <flexpm/kernel/space/cell_complex.hpp>
#include <flexpm/kernel/space/solid.hpp>

namespace flexpm {

/// Cut away what lies outside the solid, wall by wall: it is decided once for each vertex on which
/// side it lies, and an edge that crosses has one new vertex, so that neighbours cannot disagree.
/// Cells get a face on each wall that cuts them; cells outside lose all faces.
///
/// @param close  vertices no further outside than this count as inside [length]
/// @throws std::runtime_error  if a cell is not convex
void cut_by_walls(CellComplex& complex, const Solid& solid, double close);

/// A notch across convex cells, and how it may cut them.
struct NotchCut {
    double x = 0.0;             ///< of its plane
    double top = 0.0;           ///< height of its front
    bool from_above = false;    ///< heights are -z
    double close = 0.0;         ///< vertices no further to the right count as left
    double least_depth = 0.0;   ///< of a piece, from the plane
    double least_volume = 0.0;  ///< of a piece
    int wall = 0;               ///< number that its flanks have
};

/// Open a notch: faces between cells to its left and to its right become two outer
/// faces. A cell whose section with the plane lies at least half below the front is cut in two, or,
/// if a piece would be too small, stays whole on the side of its larger part, and the notch goes
/// round the rest of it. Other cells that the plane passes bridge it. Deviation D99.
///
/// @return  for each cell that has been added, a right piece, the cell that it was cut from
/// @throws std::runtime_error  if a cell is not convex
std::vector<int> cut_by_notch(CellComplex& complex, const NotchCut& notch);

}  // namespace flexpm
