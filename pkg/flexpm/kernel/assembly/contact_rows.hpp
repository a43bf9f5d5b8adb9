// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Laws and states of a block of contacts as rows, one lane of which is one contact.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>
#include <flexpm/kernel/core/compiler.hpp>

namespace flexpm {

/// Parameters of a block's contacts as rows. One for all blocks of a pass: it keeps what it holds for
/// blocks of the same law.
struct LawRows {
    static constexpr int count = sizeof(LawParameters) / sizeof(double), none = -1;
    int filled = none;  ///< index of the law in all lanes
    alignas(64) double values[count * lanes];

    void fill(const Assembly& a, int block);
};

FLEXPM_INLINE LawParameters law_of(const double* rows, int lane)
{
    const double* r = rows + lane;
    return { r[0 * lanes], r[1 * lanes], r[2 * lanes], r[3 * lanes], r[4 * lanes], r[5 * lanes],
        r[6 * lanes], r[7 * lanes], r[8 * lanes], r[9 * lanes] };
}

FLEXPM_INLINE PointState load_state(const double* rows, int lane)
{
    const double* r = rows + lane;
    return { r[0], r[lanes], r[2 * lanes], r[3 * lanes], r[4 * lanes], r[5 * lanes], r[6 * lanes] };
}

}  // namespace flexpm
