// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Linear stiffness of a bonded assembly: all contact points intact with full stiffness,
/// small displacements from the bonded state, paper Sec. 2.5 (Eqs. 9-10, 18-19). SI units.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>
#include <flexpm/kernel/fem/triangle.hpp>

#include <vector>

namespace flexpm {

/// One term of the stiffness matrix between two entries of Assembly::displacement [N/m].
struct StiffnessEntry {
    int row;
    int column;
    double value;
};

/// Springs of a point of contact per area [Pa/m], or of a plate's point [N/m].
struct PointSpring {
    double normal = 0.0;
    double shear = 0.0;
};

using PointSprings = std::vector<PointSpring>;

/// Those of all points; none: they have their full stiffness.
struct GivenSprings {
    PointSprings contacts;             ///< [contact * ContactGroup::points + point]
    std::vector<PointSprings> plates;  ///< [plate][point]; of plates that are not soft
};

/// Terms of the symmetric stiffness at the reference state, of triangles and contact points; terms
/// of equal row and column are to be summed. Rows of padded lanes do not occur.
std::vector<StiffnessEntry> stiffness_entries(const Assembly& a, const GivenSprings& springs = {});

/// Springs at one point of a plate: stiffness between the plate and the point [N/m].
StiffnessBlock plate_springs(const Plate& plate, int point);

/// Given springs along a point's normal and along the plate.
StiffnessBlock plate_springs(const Plate& plate, int point, const PointSpring& k);

/// How a soft plate answers to a motion.
struct PlateLag {
    double give = 0.0;  ///< how far it stays behind its crosshead along its normal [m]
    double turn = 0.0;  ///< about its seat, counter-clockwise [rad]
};

/// That of a plate all of whose points bear, as its crosshead moves by `displacement` and nodes
/// move so, in the layout of Grains::displacement, or not at all. Zero of one that is not soft.
PlateLag plate_lag(
    const Assembly& a, const Plate& plate, Vector displacement, const Array<double>* moved);

/// Way of a plate at one of its points, of a way of its crosshead and its answer [m].
Vector point_way(const Plate& plate, int point, Vector displacement, const PlateLag& lag);

}  // namespace flexpm
