// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Pace of a loading: slow while contact points soften, slide and crack, fast while the specimen
/// is elastic, paper Sec. 4.1. The pace is the loading rate over the slowest one [-], at least 1.
///
/// The rate alters a strength by way of what dissipates: a crack grows in steps, and the load must not
/// run ahead of it. What counts is therefore the part of the boundary's work that damage and friction
/// take. The unbalanced force would not do as a measure: a change of the rate unbalances nodes itself.
#pragma once

#include <flexpm/kernel/measure/energy_balance.hpp>

namespace flexpm {

struct PaceRule {
    double fastest = 1.0;      ///< largest pace [-]
    double slow_share = 0.02;  ///< at this dissipated share of the work the pace is 1 [-]
    double crossing = 1.0;     ///< steps in which a wave crosses the specimen
};

/// Part of the boundary's work between two states that damage and friction have taken [-]; infinite
/// if they took some without work.
double dissipated_share(const Dissipation& before, const Dissipation& now);

/// Pace of the coming steps: slow_share / share, between 1 and `fastest`. It changes smoothly: it at
/// most doubles while a wave crosses the specimen once, and at most halves in a quarter of that.
///
/// @param pace   of the last `steps` steps [-]
/// @param share  dissipated_share() of these steps [-]
double next_pace(double pace, double share, double steps, const PaceRule& rule);

}  // namespace flexpm
