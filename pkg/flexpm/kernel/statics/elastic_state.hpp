// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Where a specimen between parts would come to rest, if no contact broke further: the
/// static solution under pressures, weight and a way or a load of the driven parts. SI units,
/// tension positive.
/// Deviation D72: the solution is linear about the present state, and points without a bond, or of
/// plates that are not bonded, open or close until all agree with it. Damage stays as it is; what
/// is pressed together without a bond sticks, from where it closes on, unless it has no friction.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

#include <optional>
#include <utility>
#include <vector>

namespace flexpm {

/// What changes from the present state on.
struct ElasticLoading {
    std::vector<std::pair<int, double>> pressures;  ///< plate and pressure on its width [Pa]
    std::vector<int> plates;                        ///< driven ones
    std::vector<int> sets;                          ///< driven along, or counter-clockwise
    std::vector<int> back_sets;                     ///< those that turn clockwise
    Vector direction;                               ///< unit vector; zero if sets turn
    double turn = 0.0;                              ///< 1: sets turn
    double way = 0.0;                               ///< of what is driven, from now on [m, or rad]
    std::optional<double> load;                     ///< in the end, in place of a way [N, or N m]
};

struct ElasticState {
    Assembly state;  ///< displacements, tractions and forces of the solution; it cannot be stepped
    double way = 0.0;         ///< of what is driven, from now on [m, or rad]
    double load = 0.0;        ///< of what is driven [N, or N m]
    int solutions = 0;        ///< until points were open or closed as the solution has them
    int beyond_friction = 0;  ///< contact points that stick and would slide, or open if they stuck
};

/// @throws std::invalid_argument  if a value is out of range
/// @throws std::runtime_error     as solve_static(), if a plate under pressure meets nothing, or if
///         points neither stay open nor closed
ElasticState find_elastic_state(const Assembly& a, const ElasticLoading& loading);

}  // namespace flexpm
