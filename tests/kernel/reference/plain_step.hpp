// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  One step of a plain specimen, written from doc/theory and for no speed at all: what the
/// kernel's step, with its lanes and blocks, must agree with.
#pragma once

#include "reference/plain_specimen.hpp"

namespace plain {

/// Move, find all forces at the new places, and integrate the velocities.
/// @param dt       time step [s]
/// @param damping  alpha of Eq. 2 [-]
void step(Specimen& specimen, double dt, double damping);

}  // namespace plain
