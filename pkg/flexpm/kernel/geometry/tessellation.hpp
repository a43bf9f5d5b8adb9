// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Laguerre cells of a disc packing, clipped to an outline, paper Sec. 3.1 and Fig. 4.
#pragma once

#include <flexpm/kernel/geometry/cells.hpp>
#include <flexpm/kernel/geometry/outline.hpp>

#include <vector>

namespace flexpm {

struct TessellationOptions {
    double short_edge = 0.0;    ///< edges below this length are collapsed [m]
    bool allow_hidden = false;  ///< drop discs without a cell (counted) instead of refusing them
};

/// Cells of the discs inside the outline, short edges collapsed: shortest first, ties by vertex.
/// Corners of the outline stay, vertices on it stay on it; a collapse that would leave a cell with
/// less than three corners, or not star-shaped about its centroid, is not made. In a circle each
/// stretch of a cell on the outline is one chord. Cells keep the order of the discs.
///
/// @throws std::invalid_argument  as power_diagram(); for short_edge < 0; for a hidden disc unless
///                                allowed; for a circle with too few discs to span an area
Tessellation tessellate(
    const std::vector<Disc>& discs, const Outline& outline, const TessellationOptions& options);

}  // namespace flexpm
