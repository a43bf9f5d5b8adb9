// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Cells made fit for a mesh: slivers merged, cells split from no point of which all edges
/// are seen.
#pragma once

#include <flexpm/kernel/tiling/planar_cells.hpp>

namespace flexpm {

/// Merge each piece that is a sliver with the neighbour of the longest common stretch with which it
/// makes one cell that a point sees whole. Where there is none, it stays. A sliver has less than 2
/// % of the area of a mean cell or a width, four times area over perimeter, below 15 % of its
/// diameter. Deviation D33.
void merge_slivers(PlanarCells& cells, double mean_area);

/// Split each cell whose edges are not all seen from one point along the diagonal between two of
/// its corners that leaves the parts seen best. Deviation D32.
void split_to_stars(PlanarCells& cells);

/// Take out bends between two cells alone, where both are still seen whole from a point: a merged
/// sliver leaves them.
void straighten_edges(PlanarCells& cells);

/// Collapse edges shorter than a length, as in a Laguerre diagram; corners of the outline stay.
void collapse_short_edges(PlanarCells& cells, double short_edge);

}  // namespace flexpm
