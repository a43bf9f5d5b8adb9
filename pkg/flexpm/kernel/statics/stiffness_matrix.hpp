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

/// Springs of a point of contact per area [Pa/m].
struct PointSpring {
    double normal = 0.0;
    double shear = 0.0;
};

/// [contact * ContactGroup::points + point]; none: all points have their full stiffness.
using PointSprings = std::vector<PointSpring>;

/// Terms of the symmetric stiffness at the reference state, of triangles and contact points; terms
/// of equal row and column are to be summed. Rows of padded lanes do not occur.
std::vector<StiffnessEntry> stiffness_entries(const Assembly& a, const PointSprings& springs = {});

/// Springs at one point of a plate: stiffness between the plate and the point [N/m].
StiffnessBlock plate_springs(const Plate& plate, int point);

/// How far a plate in a soft machine stays behind its crosshead along its normal, as this moves by
/// `displacement` and nodes move so, in the layout of Grains::displacement, or not at all [m]. All
/// of its points bear. 0 without a machine.
double machine_lag(
    const Assembly& a, const Plate& plate, Vector displacement, const Array<double>* moved);

}  // namespace flexpm
