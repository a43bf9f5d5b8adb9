// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Check of a state that comes from outside, as a file hands it over.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

namespace flexpm {

/// Refuse a state whose arrays do not fit each other or name what does not exist: whoever used it
/// would read and write foreign memory. Numbers that are only calculated with may have any value.
/// @throws std::invalid_argument  in one line that names the part
void check_state(const Assembly& a);

}  // namespace flexpm
