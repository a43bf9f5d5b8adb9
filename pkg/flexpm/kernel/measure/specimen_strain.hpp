// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Mean strains of a rectangular specimen, paper Sec. 4.1. Extension positive.
/// Deviation D21: strains of rigid grains come from their centres, axial ones between bands at a
/// quarter and three quarters of the height, so that the contacts with plates do not count.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

namespace flexpm {

/// Sides of a rectangle, in the order of its outline.
enum RectangleSide { bottom_side = 0, right_side = 1, top_side = 2, left_side = 3 };

struct SpecimenStrain {
    double axial = 0.0;    ///< along y [-]
    double lateral = 0.0;  ///< along x, between the means of the left and right sides [-]
};

/// Deformable grains: from the mean displacements of the four sides. Rigid grains: from those of the
/// centres in the two bands and along the left and right sides.
/// @throws std::invalid_argument  if a side has no edges, or a band no grain
SpecimenStrain specimen_strain(const Assembly& a);

}  // namespace flexpm
