// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Motion of a plate that a load presses on, along its normal, paper Sec. 4.1. SI units.
#pragma once

#include <flexpm/kernel/assembly/parts.hpp>

namespace flexpm {

/// New velocity of a loaded plate, which answers to its load and to the specimen along its normal,
/// and its works. Deviation D57: with loose grains alone before it the load would drive it through
/// the specimen and does not act.
///
/// @param undamped  part of its speed that damping does not act on [m/s]
/// @param bears  whether it lies before a grain that is not loose
void integrate_loaded(Plate& plate, double undamped, bool bears, double dt, double damping);

/// Let no load move a plate any more; the half step that it was promised is not taken.
void let_go(Plate& plate);

}  // namespace flexpm
