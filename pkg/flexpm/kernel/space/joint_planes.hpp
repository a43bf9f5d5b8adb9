// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Joints, holes and notches of a solid, cut into its cells one after the other. SI units.
#pragma once

#include <flexpm/kernel/space/plane_cuts.hpp>
#include <flexpm/kernel/space/solid.hpp>

#include <vector>

namespace flexpm {

/// Plane of a joint, or a convex polygon in it.
struct JointPlane {
    Vector normal;                     ///< of length 1
    double offset = 0.0;               ///< [m]
    std::vector<Vector> corners = {};  ///< in any sense of rotation; none: the whole plane [m]
};

/// Convex polyhedron that is taken out of a solid, as the polygons of its facets, whose normals
/// point out of it.
using Hole = std::vector<JointPlane>;

/// Volumes of a hole, before short edges are collapsed [m^3].
struct HoleOutcome {
    double within = 0.0;   ///< of the polyhedron, inside the cells before it was cut
    double removed = 0.0;  ///< of the cells that were taken out
};

/// Notch across a solid, along y, from below or from above. Deviation D99.
struct NotchPlane {
    double x = 0.0;      ///< [m]
    double front = 0.0;  ///< z [m]
    bool from_above = false;
};

/// Outcome of a joint: areas before short edges are collapsed [m^2].
struct JointOutcome {
    double within = 0.0;  ///< of the plane or polygon, inside the solid
    CutAreas areas;
};

/// Outcome of all cuts.
struct CutCells {
    std::vector<int> sources;  ///< for each added cell, a right piece, the whole cell that it was
    std::vector<JointOutcome> joints;
    std::vector<HoleOutcome> holes;
    std::vector<int> gone;  ///< cells that holes have taken out, in order
};

/// Cut cells along joints, then along the facets of holes, and then along notches.
/// A piece has at least 2 % of the mean volume and
/// 15 % of the mean diameter as its depth, and no edge below 5 degrees beside a joint. Faces of
/// joint i have the number i. Flanks of notch i have the wall index walls + i, faces on the wall of
/// hole i have first_hole_wall() + i. Parts of a cell beyond the edges of a facet stay cells of
/// their own. A cell leaves with at least half of its volume in the hole, deviation D108.
///
/// @param diameter  mean diameter of the whole cells' spheres
/// @throws std::invalid_argument  for a number that is not finite, a normal that is not of length
///                                1, or a polygon that is not in its plane, not convex or without
///                                area
CutCells cut_cells(CellComplex& complex, const Solid& solid, double diameter,
    const std::vector<JointPlane>& joints, const std::vector<NotchPlane>& notches,
    const std::vector<Hole>& holes = {});

/// Index of the wall of the first hole.
int first_hole_wall(const Solid& solid, const std::vector<NotchPlane>& notches);

/// Area of a joint inside a solid.
double area_within(const JointPlane& joint, const Solid& solid);

}  // namespace flexpm
