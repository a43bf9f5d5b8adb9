// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Outlines of any shape, with holes, and cells clipped by them in exact numbers. SI units.
#pragma once

#include <flexpm/kernel/tiling/planar_cells.hpp>

#include <vector>

namespace flexpm {

/// A simple polygon, not convex too, with holes. Its sides are numbered from the first corner on,
/// then those of the holes.
struct PolygonOutline {
    std::vector<Point> corners;             ///< counter-clockwise [m]
    std::vector<std::vector<Point>> holes;  ///< each clockwise [m]

    /// Outline from rings in any sense.
    /// @throws std::invalid_argument  unless the rings are finite and simple, no angle is below 5
    ///                                degrees, and the holes lie inside without a common point
    static PolygonOutline make(std::vector<Point> corners, std::vector<std::vector<Point>> holes);

    /// All rings, the outer one first.
    std::vector<std::vector<Point>> rings() const;
    double area() const;  ///< [m^2]
};

/// The parts of cells inside an outline. A cell of which nothing is cut off is whole; others become
/// one cell for each part that hangs together. A hole inside a cell is joined to its rim by two
/// cuts.
/// @throws std::invalid_argument  if a cell has two holes
PlanarCells clip_cells(const Tessellation& tessellation, const PolygonOutline& outline);

/// Two cells that a hole in a cell leaves around it, cut from the corners of the hole furthest left
/// and right to the nearest corners of the rim on either side of its middle. Deviation D32.
/// @param rim     counter-clockwise
/// @param hole    clockwise
/// @param others  more holes, which no cut meets; from other corners if these are in the way
/// @return        none if the corners do not see the rim
std::vector<Loop> open_ring(const std::vector<Point>& vertices, const Loop& rim, const Loop& hole,
    const std::vector<Loop>& others);

/// Two sides of rings that cross or touch, -1: none. Neighbours in a ring share an end, which is no
/// touch.
struct SidePair {
    int first = -1, second = -1;
};
SidePair crossing_sides(const std::vector<std::vector<Point>>& rings);

}  // namespace flexpm
