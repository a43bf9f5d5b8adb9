// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The tiles of a step: contacts that are updated before the grains that have no contact
/// left.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

namespace flexpm {

/// Contact blocks of one tile: as many as fit a second-level cache with their grains, and few
/// enough to share a small specimen out to threads.
constexpr int tile_length = 64;

/// Tiles from the contacts. Grains without contacts belong to the first tile.
Tiles make_tiles(const Grains& grains, const Contacts& contacts);

}  // namespace flexpm
