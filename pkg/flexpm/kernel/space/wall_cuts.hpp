// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Cells cut by the walls of a solid.
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

}  // namespace flexpm
