// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The record of cracked points: when, how, where, and what their damage took.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

namespace flexpm {

/// Note the points of a block of contacts that `cracked` marks, [point][lane], as cracked at the
/// end of the step `dt` that is under way.
void record_cracks(Assembly& a, int block, double dt, const std::uint8_t* cracked);

/// Note the points of a bond that have not cracked as erased after the last step, where they are
/// now. They will not crack any more. Their areas must be there still.
void record_erasure(Assembly& a, int contact);

}  // namespace flexpm
