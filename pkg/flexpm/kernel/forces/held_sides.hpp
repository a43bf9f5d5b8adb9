// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Sides that are kept from moving along an axis. SI units.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

namespace flexpm {

/// Keep a side from moving along an axis from now on: nodes of deformable grains; of rigid grains
/// the centres where the axis runs across the side, and the edges where it runs along it. Deviation
/// D48: held by its centre there, a grain would carry the half of its mass that lies outwards
/// without the shear stress that moves it.
/// @throws std::invalid_argument  if no facet lies on the side
void hold_side(Assembly& a, int side, int axis);

/// Push on the edges of rigid grains that are held, so that they stand still over the coming step
/// of `dt`. What does not move takes no work. Called by step().
void hold_edges(Assembly& a, double dt);

}  // namespace flexpm
