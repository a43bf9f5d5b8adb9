// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/assembly/law_rows.hpp>

#include <algorithm>

namespace flexpm {

/// Few blocks differ from the one before: most find their rows filled.
void LawRows::fill(const Contacts& contacts, int block)
{
    if (filled == 0 && contacts.laws.size() == 1) return;
    const int first = block * lanes, last = std::min(first + lanes, contacts.count) - 1;
    const int* kinds = contacts.law.data();
    const bool one =
        std::all_of(kinds + first, kinds + last, [kind = kinds[last]](int k) { return k == kind; });
    if (one && kinds[last] == filled) return;
    filled = one ? kinds[last] : none;
    dilating = false;
    for (int l = 0; l < lanes; ++l) {
        const LawParameters& law = contacts.laws[kinds[std::min(first + l, last)]];
        store_law(law, values, l);
        dilating = dilating || law.dilation_compliance > 0.0;
    }
}

}  // namespace flexpm
