// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Laws of a block of contacts as rows.
#include <flexpm/kernel/assembly/contact_rows.hpp>

#include <algorithm>

namespace flexpm {

/// Few blocks differ from the one before: most find their rows filled.
void LawRows::fill(const Assembly& a, int block)
{
    if (filled == 0 && a.laws.size() == 1) return;
    const int first = block * lanes, last = std::min(first + lanes, a.contacts) - 1;
    const int* kinds = a.contact_law.data();
    const bool one =
        std::all_of(kinds + first, kinds + last, [kind = kinds[last]](int k) { return k == kind; });
    if (one && kinds[last] == filled) return;
    filled = one ? kinds[last] : none;
    for (int l = 0; l < lanes; ++l) {
        const double* law = &a.laws[kinds[std::min(first + l, last)]].normal_stiffness;
        for (int r = 0; r < count; ++r)
            values[r * lanes + l] = law[r];
    }
}

}  // namespace flexpm
