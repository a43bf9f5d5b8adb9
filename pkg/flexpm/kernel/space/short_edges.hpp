// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Collapse of short edges of polyhedral cells.
#pragma once

#include <flexpm/kernel/space/cell_complex.hpp>

#include <vector>

namespace flexpm {

/// Collapse edges shorter than `threshold`, shortest first, ties by vertex: to the vertex on more
/// walls, so that the outline stays, or else to the middle or, where that cannot be, to one of the
/// ends. Faces with fewer than three corners go. What was refused is tried again while others go.
///
/// A collapse is not made if the walls of one end are not all walls of the other; if a polygon
/// would touch itself or a cell keep fewer than four faces; or if an angle between sides of a
/// tetrahedron (see face_triangles()) would be below 2 degrees and smaller than before. Triangles
/// that still have a short edge must only keep a volume: they go in their turn.
///
/// Corners of joints that are off their planes are moved into them, by collapses of edges of any
/// length, alone or together with others of their joint, under the same rules. Corners that cannot
/// move stay.
///
/// @param centres  per cell, the common corner of its tetrahedra
/// @return         number of short edges that stay
int collapse_short_edges(
    CellComplex& complex, const std::vector<Vector>& centres, double threshold);

}  // namespace flexpm
