// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Cells cut by joints: what one cuts becomes two cells, with a contact of the joint between them. SI units.
/// Deviation D35: what a cut may leave.
#pragma once

#include <flexpm/kernel/tiling/joint_path.hpp>

namespace flexpm {

/// Cut cells by the lines of joints, one after the other. Within a cell a line is straight. Where a cut would leave a
/// piece below 2 % of the area of a mean cell, an angle below 5 degrees, or a piece whose edges no point sees, the joint
/// goes along edges around it. An edge keeps the joint that it got first. A cell that is not cut keeps its disc as long
/// as its centre sees all edges.
///
/// @param discs   of the cells
/// @param joints  per shared edge: joint that it has already, -1: none; empty: none has one
/// @throws std::invalid_argument  for a line of less than two points, one that lies outside, one longer than 1e6 sizes
Tiling cut_by_joints(const Tessellation& tessellation, const std::vector<Disc>& discs,
    const std::vector<int>& joints, const std::vector<JointLine>& lines);

}  // namespace flexpm
