// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Collapse of short edges of a cell complex, paper Sec. 3.1.
#pragma once

#include <flexpm/kernel/geometry/power_diagram.hpp>

#include <vector>

namespace flexpm {

/// Collapse edges shorter than `threshold`, shortest first, ties by vertex index. Two inner
/// vertices meet in the middle; outline corners stay, outline vertices stay on the outline. Cells
/// without edges (hidden discs) are ignored. A collapse that would spoil a cell is not made.
///
/// @param smallest  smallest area of a triangle (centroid, edge) of a changed cell; a small
///                  negative value lets edges of zero length go one by one
/// @param seen_from_any  a changed cell is sound, too, if a point other than its centroid sees all
///         its edges
/// @return          for each vertex, whether a collapsed edge ended in it
std::vector<bool> collapse_edges(PowerDiagram& diagram, const Outline& outline, double threshold,
    double smallest, bool seen_from_any = false);

}  // namespace flexpm
