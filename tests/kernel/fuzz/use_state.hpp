// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  All that a program does with a state, a little of each.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

namespace fuzz {

/// @throws std::invalid_argument, std::runtime_error  where the kernel refuses
void use_state(flexpm::Assembly& a);

}  // namespace fuzz
