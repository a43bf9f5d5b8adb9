// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The plan of a step of a specimen in space.
#pragma once

#include <flexpm/kernel/assembly/solid_state.hpp>

namespace flexpm {

/// Tile of a contact, see FaceContacts.
int tile_of(const SolidState& s, int contact);

/// Whether its grains are of two tiles.
bool reaches_out(const SolidState& s, int contact);

/// Derive the plan of a step, after a state was made or loaded.
void prepare_step(SolidState& s);

}  // namespace flexpm
