// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Where a line crosses the edges of cells, as steps from vertex to vertex. SI units.
/// Deviation D35: a vertex close to the line is moved onto it where the cells around it stay sound,
/// and stands for the place where the line passes.
#pragma once

#include <flexpm/kernel/tiling/cell_index.hpp>

#include <set>
#include <vector>

namespace flexpm {

/// Line of a joint through two points or more.
struct JointLine {
    std::vector<Point> points;  ///< [m]
    int joint = 0;              ///< number of the joint
};

/// Distance from a line within which vertices are on it, in mean diameters.
constexpr double snap_distance = 0.1;

/// A step of a line within one cell, or along an edge.
struct JointStep {
    int from, to;   ///< vertices
    double length;  ///< of the line along it [m]
};

/// Steps of a line, in its order. Vertices are put into the edges that it crosses far from their
/// ends. An end within a cell is moved to the cell's edge: on if the line has covered half of its
/// way through the cell, else back.
/// @param mean_area  of a cell
std::vector<JointStep> joint_steps(CellIndex& cells, const JointLine& line, double mean_area);

/// Length of a line outside of all cells [m].
double length_outside(const CellIndex& cells, const JointLine& line);

/// Move vertices of a joint that went along edges onto its line, where the cells around them stay
/// sound.
/// @param vertices   of the joint
/// @param laid       its edges; those of other joints stay straight
/// @param mean_area  of a cell
void straighten(CellIndex& cells, const JointLine& line, const std::vector<int>& vertices,
    const std::set<VertexPair>& laid, double mean_area);

}  // namespace flexpm
