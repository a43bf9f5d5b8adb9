// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Grains of an outline of any shape: the Laguerre cells of a packing, sawn out along it. SI
/// units.
#pragma once

#include <flexpm/kernel/tiling/clipping.hpp>

namespace flexpm {

/// Laguerre cells of discs inside an outline. The discs fill more than the outline; those of which
/// it holds nothing are left out. A piece that is a sliver is merged with a neighbour (Deviation
/// D33), one whose edges are not all seen from one point is split (Deviation D32).
///
/// @param short_edge  edges below this length are collapsed [m]
/// @throws std::invalid_argument  as tessellate(), or for holes that one cell cannot have
Tiling cells_in_outline(
    const std::vector<Disc>& discs, const PolygonOutline& outline, double short_edge);

}  // namespace flexpm
