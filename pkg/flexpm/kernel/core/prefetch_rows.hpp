// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Asking for memory some time before it is read or written.
#pragma once

#include <flexpm/kernel/core/array.hpp>
#include <flexpm/kernel/core/compiler.hpp>

namespace flexpm {

/// Ask for `count` rows of `lanes` values from `first` on, which may lie past the end of its array.
template <class T> FLEXPM_INLINE void prefetch_rows(const T* first, int count)
{
    constexpr int line = 64 / sizeof(T);
    for (int i = 0; i < count * lanes; i += line)
        __builtin_prefetch(first + i);
}

}  // namespace flexpm
