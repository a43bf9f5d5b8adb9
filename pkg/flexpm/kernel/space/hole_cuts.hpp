// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Cells within a convex polyhedron taken out of a solid. Deviation D108.
#pragma once

#include <flexpm/kernel/space/joint_planes.hpp>
#include <flexpm/kernel/space/plane_cuts.hpp>

#include <vector>

namespace flexpm {

/// A hole as its facets, which are checked.
struct HoleCut {
    std::vector<PlaneCut> facets;
    std::vector<std::vector<Vector>> polygons;  ///< of each facet, counter-clockwise from outside
    int wall = 0;                               ///< of faces that come to lie on the hole
};

/// Cut cells by the facets of a hole, and take out what lies within.
/// @param close  distance up to which vertices lie on a plane
/// @param gone   to which the cells are added that are taken out
HoleOutcome cut_hole(CellComplex& complex, CellCutter& cutter, const HoleCut& hole, double close,
    std::vector<int>& gone);

/// Once all holes are cut: faces between cells that stay do not lie on facets, their vertices are
/// free of facets' planes, and faces without corners are erased.
/// @param first_facet  number of the first facet, as those of joints
void finish_holes(CellComplex& complex, int first_facet);

}  // namespace flexpm
