// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Adaptive loading rate: slow while contact points soften, slide and crack, fast while the
/// specimen is elastic, paper Sec. 4.1. It is a factor on the slowest velocity of the loading [-],
/// at least 1.
///
/// The rate alters a strength by way of what dissipates: a crack grows in steps, and the load must
/// not run ahead of it. What counts is therefore the part of the boundary's work that damage and
/// friction take. The unbalanced force would not do as a measure: a change of the rate unbalances
/// nodes itself.
#pragma once

#include <flexpm/kernel/measure/energy_balance.hpp>

namespace flexpm {

struct LoadingRateRule {
    double fastest = 1.0;      ///< largest factor [-]
    double slow_share = 0.02;  ///< at this dissipated share of the work the factor is 1 [-]
    double crossing = 1.0;     ///< steps in which a wave crosses the specimen
};

/// Part of the boundary's work between two states that damage and friction have taken [-]; infinite
/// if they took some without work.
double dissipated_share(const Dissipation& before, const Dissipation& now);

/// Velocity factor of the coming steps: slow_share / share, between 1 and `fastest`. It changes
/// smoothly: it at most doubles while a wave crosses the specimen once, and at most halves in a
/// quarter of that.
///
/// @param factor  of the last `steps` steps [-]
/// @param share   dissipated_share() of these steps [-]
/// @throws std::invalid_argument  if a number of the rule is out of range
double next_velocity_factor(double factor, double share, double steps, const LoadingRateRule& rule);

}  // namespace flexpm
