// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Where the grains of a block are and how they move: for contacts, and for all who watch
/// them step by step. SI units, rotations counter-clockwise.
#pragma once

#include <flexpm/kernel/assembly/grains.hpp>

namespace flexpm {

/// [lane]; padded lanes have values without meaning.
struct CentreMotion {
    alignas(64) double x[lanes], y[lanes];    ///< centre at the end of the step [m]
    alignas(64) double vx[lanes], vy[lanes];  ///< its velocity, half a step later [m/s]

    // rigid grains only
    alignas(64) double half_cosine[lanes], half_sine[lanes];  ///< of half the angle turned
    alignas(64) double spin[lanes];                           ///< [rad/s]
};

/// Displacements of the centres of a block of grains at the end of the step, into
/// StepPlan::next_centre: contacts read them there.
void predict_centres(const Grains& grains, int block, double dt, Array<double>& next_centre);

void find_centre_motion(const Grains& grains, int block, CentreMotion& motion);

}  // namespace flexpm
