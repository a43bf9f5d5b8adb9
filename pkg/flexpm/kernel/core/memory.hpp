// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Memory of the process.
#pragma once

namespace flexpm {

/// Give freed memory back to the system, which the C library keeps for later. Call it after what
/// has needed much for a short time.
void give_back_memory();

}  // namespace flexpm
