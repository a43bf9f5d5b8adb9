// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Mean strains of a rectangular specimen, paper Sec. 4.1. Extension positive.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>
#include <flexpm/kernel/measure/centre_strain.hpp>

namespace flexpm {

/// Deformable grains: from the mean displacements of the four sides. Rigid grains: centre_strain().
/// @throws std::invalid_argument  if a side has no edges, or a band no grain
SpecimenStrain specimen_strain(const Assembly& a);

/// The same where nodes move so, in the layout of Grains::displacement.
SpecimenStrain specimen_strain(const Assembly& a, const Array<double>& moved);

}  // namespace flexpm
