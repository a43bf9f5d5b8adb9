// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Asking for memory some time before it is read, where a step's arrays exceed the caches. It is
/// asked for bit by bit between computations: a core can wait for few lines at once.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>
#include <flexpm/kernel/core/compiler.hpp>

namespace flexpm {

/// Whether a step reads more than the caches keep until the next one.
inline bool exceeds_caches(const Assembly& a)
{
    constexpr int cached_contacts = 1 << 14;
    return a.contacts > cached_contacts;
}

/// Ask for `count` rows of `lanes` values from `first` on, which may lie past the end of its array.
template <class T> FLEXPM_INLINE void fetch_rows(const T* first, int count)
{
    constexpr int line = 64 / sizeof(T);
    for (int i = 0; i < count * lanes; i += line)
        __builtin_prefetch(first + i);
}

/// Fill `fetch_first` and `fetch_lines`.
void list_fetches(Assembly& a);

/// Ask for what a block of contacts gathers from the nodes of its grains.
inline void fetch_nodes(const Assembly& a, int block)
{
    for (int i = a.fetch_first[block]; i < a.fetch_first[block + 1]; ++i) {
        const int line = a.fetch_lines[i];
        if (line >= 0) {
            fetch_rows(a.velocity.data() + line * lanes, 2);
        } else {
            fetch_rows(a.next_centre.data() + ~line * lanes, 1);
        }
    }
}

}  // namespace flexpm
