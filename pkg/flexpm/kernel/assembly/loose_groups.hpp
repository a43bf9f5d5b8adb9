// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Grains that no chain of contacts joins to what is held, in the plane and in space,
/// deviation D57.
#pragma once

#include <flexpm/kernel/assembly/grains.hpp>
#include <flexpm/kernel/assembly/parts.hpp>
#include <flexpm/kernel/core/groups.hpp>

#include <vector>

namespace flexpm {

/// Mark as loose all grains whose group has none that is held. Where nothing is held, the largest
/// group stands, by the area of its discs or the volume of its spheres.
///
/// @param held  1: nodes of the grain have a given velocity, or it touches a plate that has
void mark_loose(Grains& grains, Groups& groups, const std::vector<std::uint8_t>& held);

/// Whether a load moves any plate.
bool loads_any(const std::vector<Plate>& plates);

/// Mark the grains that touch plates which no load moves.
///
/// @param grain_of  grain of each facet of the boundary
void mark_touching(const std::vector<Plate>& plates, const std::vector<int>& grain_of,
    std::vector<std::uint8_t>& marked);

/// Whether a plate lies before a grain that is not loose.
bool bears_any(const Plate& plate, const std::vector<int>& grain_of, const Grains& grains);

}  // namespace flexpm
