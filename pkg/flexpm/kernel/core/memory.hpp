// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Memory of the process.
#pragma once

#include <cstddef>

namespace flexpm {

/// Give freed memory back to the system, which the C library keeps for later. Call it after what
/// has needed much for a short time.
void give_back_memory();

/// Ask the system for large pages in memory that nothing has written to yet; where it refuses, the
/// small ones stay.
void ask_for_large_pages(void* first, std::size_t bytes);

}  // namespace flexpm
