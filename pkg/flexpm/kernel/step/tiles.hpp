// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The order in which a step goes through its blocks: some contacts, then the grains that have no
/// contact left, and so on. What contacts read and write is then still in a cache when the grains follow.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

namespace flexpm {

/// Contact blocks of one chunk: as many as fit a second-level cache with their grains, and few enough
/// to share a small specimen out to threads.
constexpr int chunk_length = 64;

/// Fill `chunk_first`, `chunk_blocks` and `first_chunk` from the contacts. Grains without contacts follow the
/// first chunk.
void list_chunks(Assembly& a);

}  // namespace flexpm
