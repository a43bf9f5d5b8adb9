// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Young's modulus and Poisson's ratio of a specimen by one static solve, paper Sec. 4.1. SI
/// units.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

namespace flexpm {

/// Elastic constants of a specimen as a whole; under plane strain they are the apparent ones.
struct ElasticConstants {
    double youngs_modulus;  ///< [Pa]
    double poissons_ratio;  ///< [-]
};

/// Test a rectangle in uniaxial tension (sides 0 bottom, 1 right, 2 top, 3 left): bottom and top
/// nodes are held and moved axially (y) only. The modulus follows from the top's reaction over the
/// initial area, Poisson's ratio from the mean displacements of the left and right sides.
///
/// @throws std::invalid_argument  if one of the four sides is missing
/// @throws std::runtime_error     as solve_static()
ElasticConstants elastic_constants(const Assembly& a);

}  // namespace flexpm
