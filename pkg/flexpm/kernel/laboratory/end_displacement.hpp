// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Driven ends of a rectangle of deformable grains, the ramp of a load, and where a specimen
/// between ends would come to rest, paper Sec. 4.1. SI units.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>
#include <flexpm/kernel/statics/elastic_state.hpp>

#include <cstdint>
#include <optional>

namespace flexpm {

/// @throws std::invalid_argument  unless the outline has the four sides of a rectangle
void need_sides(const Assembly& a);

/// Hold the bottom axially and one of its nodes laterally; nothing moves yet.
void grip_bottom(Assembly& a);

/// Move the top at `velocity` [m/s], positive away from the bottom.
void move_top(Assembly& a, double velocity);

/// Part of the full load in the coming step of a ramp over `ramp_steps`, which begins and ends
/// gently [-]: with x of its steps done 10 x^3 - 15 x^4 + 6 x^5.
double ramp_factor(std::int64_t step, int ramp_steps);

/// Load of the coming step that goes from `start` to `full` in this way, `done` steps after it was
/// asked for.
double ramped(double start, double full, std::int64_t done, int ramp_steps);

/// What is asked of a specimen between two ends.
struct EndLoading {
    bool plates = false;             ///< between plates, which are laid unless they are there
    bool disc = false;               ///< they touch a disc
    bool tension = false;            ///< the upper end is pulled, plates are bonded
    int pieces = 1;                  ///< plates of the membrane on each side
    std::optional<double> pressure;  ///< on the sides, and on a top that is not driven [Pa]
    double way = 0.0;                ///< of the upper end along the loading, under the pressure [m]
    std::optional<double> load;      ///< in the end, in place of a way [N]
};

/// Where it would come to rest, if no contact broke further, see find_elastic_state(). Ends are as
/// a test has them: smooth, the lower one at rest, one place in its middle held laterally.
/// @throws std::invalid_argument  as find_elastic_state(), or if a disc is to have a pressure
/// @throws std::runtime_error     likewise
ElasticState find_end_state(const Assembly& a, const EndLoading& asked);

}  // namespace flexpm
