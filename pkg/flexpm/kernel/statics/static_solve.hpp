// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Linear elastic equilibrium of a bonded assembly by one sparse direct solve, paper Sec.
/// 4.1. SI units, tension positive.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>
#include <flexpm/kernel/statics/stiffness_matrix.hpp>

#include <vector>

namespace flexpm {

/// A displacement component with a given value.
struct Prescribed {
    int index;     ///< into Assembly::displacement: node component(offset, axis)
    double value;  ///< [m]
};

/// Displacements and forces in the layout of Assembly::displacement, zero in padded lanes.
struct StaticSolution {
    Array<double> displacement;  ///< [m]
    Array<double> force;         ///< of triangles and contacts on the nodes [N]; reactions = -force
};

/// What acts in one of several solutions of the same assembly.
struct StaticCase {
    std::vector<Prescribed> prescribed;    ///< the same components in all cases
    std::vector<Vector> plates;            ///< displacement of each plate, or crosshead [m]
    std::vector<double> angles;            ///< of each node set that floats, about z [rad]
    const Array<double>* loads = nullptr;  ///< as for solve_static()
    std::vector<double> turns = {};        ///< of each plate about its seat [rad]; none: 0
};

/// solve_static() for several cases by one factorisation, with the springs as given.
///
/// @throws std::invalid_argument  as solve_static(), or if the components, plates or angles of a
///         case are others than those of the assembly and the first case
/// @throws std::runtime_error     as solve_static()
std::vector<StaticSolution> solve_static_cases(
    const Assembly& a, const std::vector<StaticCase>& cases, const GivenSprings& springs);

/// Displacements at which the nodal forces balance `loads` wherever nothing is prescribed. Node
/// sets that float turn by their angle, as plates have their displacement.
///
/// @param loads  forces from outside, layout of Assembly::displacement [N]; none if null
/// @throws std::invalid_argument  if a number is not finite, an index names no component of a grain
///         or is given twice with two values, or `loads` has another size
/// @throws std::runtime_error     if a part of the assembly can move freely
StaticSolution solve_static(const Assembly& a, const std::vector<Prescribed>& prescribed,
    const Array<double>* loads = nullptr);

}  // namespace flexpm
