// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Driven ends of a rectangle of deformable grains, and the ramp of a load, paper Sec. 4.1.
/// SI units.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

#include <cstdint>

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

}  // namespace flexpm
