// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Pressure on sides of a specimen in 3D, paper Sec. 4.1. It acts on the surface triangles of
/// deformable and of rigid grains and follows them. SI units.
#pragma once

#include <flexpm/kernel/assembly/solid_state.hpp>

namespace flexpm {

/// Pressure on a side (SolidSide) from the next step on, on the deformed triangles, compressive
/// positive [Pa]. It acts on grains that are not loose.
/// @throws std::invalid_argument  if no triangle lies on the side, or the pressure is below 0
void set_pressure(SolidState& s, int side, double pressure);

/// Whether a pressure acts on any side.
bool is_pressed(const SolidState& s);

/// Pressures on the sides between the ends [Pa].
struct SidePressures {
    double least = 0.0;
    double largest = 0.0;
};
SidePressures side_pressures(const SolidState& s);

/// Add the forces of pressures on the nodes of a block of grains, at their present places, and find
/// the works since the last ones.
void add_pressure_forces(SolidState& s, int block);

/// Force of a pressure on a triangle at the last forces [N].
Vector pressure_on(const SolidState& s, int triangle);

/// Sum the works of all pressures after the grains have moved by a step.
void sum_pressure_work(SolidState& s);

}  // namespace flexpm
