// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  One linear solution of a specimen between parts, whose points are open or closed as they
/// are told to be, and the motions that it is made of. SI units, tension positive.
#pragma once

#include <flexpm/kernel/statics/elastic_state.hpp>
#include <flexpm/kernel/statics/one_sided_points.hpp>

#include <vector>

namespace flexpm {

/// Displacements from the present state, and what follows from them in proportion.
struct Motion {
    Array<double> displacement;  ///< [m]
    /// On the nodes, of all but the growth of what points of contacts and plates bear [N].
    Array<double> force;
    std::vector<PlateWay> plates;
    std::vector<double> gives;   ///< of the springs of machines, what they are longer by [m]
    std::vector<double> angles;  ///< of node sets that float [rad]
    double way = 0.0;            ///< of what is driven [m, or rad]

    /// Add a part of another one.
    void add(const Motion& other, double factor);
};

/// How a line from one motion to another begins, or all of it.
Motion between(const Motion& from, const Motion& to, double part);

/// Largest displacement of a node [m].
///
/// @throws std::runtime_error  if one is not finite
double largest(const Array<double>& displacements);

/// Load of what is driven, of a state with forces [N, or N m].
double load_of(const Assembly& a, const ElasticLoading& loading);

/// State after a motion: displacements, tractions and forces.
Assembly state_after(
    const Assembly& a, const OneSidedPoints& points, const Bearing& bearing, const Motion& m);

/// How much the energy of a specimen and of its loads grows along a step, after a motion [J].
///
/// What is closed is as the motion has it; what sticks is told.
double energy_growth(const Assembly& a, const ElasticLoading& loading, const OneSidedPoints& points,
    const Bearing& sticking, const Motion& m, const Motion& step);

/// The motion to where plates under a load, in a soft machine or on a seat, and what is driven by a
/// load have found their way, with points that bear so.
///
/// @param a  the present state with its pressures, and forces on its nodes
/// @throws std::runtime_error  as solve_static(), or if nothing resists a pressed or driven part
Motion solve_motion(const Assembly& a, const ElasticLoading& loading, const OneSidedPoints& points,
    const Bearing& bearing);

}  // namespace flexpm
