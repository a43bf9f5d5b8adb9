// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Linear elastic equilibrium of a bonded assembly by one sparse direct solve: all contact
/// points intact with full stiffness, small displacements from the bonded state, paper Sec. 2.5
/// (Eqs. 9-10, 18-19) and 4.1. SI units, tension positive.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

#include <vector>

namespace flexpm {

/// One term of the stiffness matrix between two entries of Assembly::displacement [N/m].
struct StiffnessEntry {
    int row;
    int column;
    double value;
};

/// Terms of the symmetric stiffness at the reference state, of triangles and contact points; terms
/// of equal row and column are to be summed. Rows of padded lanes do not occur.
std::vector<StiffnessEntry> stiffness_entries(const Assembly& a);

/// A displacement component with a given value.
struct Prescribed {
    int index;     ///< into Assembly::displacement: node offset + component * lanes
    double value;  ///< [m]
};

/// Both in the layout of Assembly::displacement, zero in padded lanes.
struct StaticSolution {
    Array<double> displacement;  ///< [m]
    Array<double> force;         ///< of triangles and contacts on the nodes [N]; reactions = -force
};

/// Displacements at which the nodal forces balance `loads` wherever nothing is prescribed.
///
/// @param loads  forces from outside, layout of Assembly::displacement [N]; none if null
/// @throws std::invalid_argument  if a number is not finite, an index names no component of a grain
///         or is given twice with two values, or `loads` has another size
/// @throws std::runtime_error     if a part of the assembly can move freely
StaticSolution solve_static(const Assembly& a, const std::vector<Prescribed>& prescribed,
    const Array<double>* loads = nullptr);

/// Of the assembly as a specimen: under plane strain they are the apparent ones.
struct ElasticConstants {
    double youngs_modulus;  ///< [Pa]
    double poissons_ratio;  ///< [-]
};

/// Uniaxial test of a rectangle (sides 0 bottom, 1 right, 2 top, 3 left): bottom and top nodes held
/// and moved axially (y) only. Modulus from the top's reaction over the initial area, Poisson's ratio
/// from the mean displacements of the left and right sides.
///
/// @throws std::invalid_argument  if one of the four sides is missing
/// @throws std::runtime_error     as solve_static()
ElasticConstants elastic_constants(const Assembly& a);

}  // namespace flexpm
