// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/assembly/law_rows.hpp>

#include <algorithm>
#include <cstring>

namespace flexpm {

LawRows::LawRows()
{
    std::fill_n(filled, lanes, -1);
    std::fill_n(lane_dilates, lanes, false);
    std::fill_n(lane_weakens, lanes, false);
}

/// Few lanes differ from those of the block before: most find their rows filled.
void LawRows::fill(const Contacts& contacts, int block)
{
    if (filled[0] == 0 && contacts.laws.size() == 1) return;
    const int first = block * lanes;
    const int* kinds = contacts.law.data();
    if (first + lanes <= contacts.count && std::memcmp(filled, kinds + first, sizeof filled) == 0)
        return;
    const int last = std::min(first + lanes, contacts.count) - 1;
    for (int l = 0; l < lanes; ++l) {
        const int kind = kinds[std::min(first + l, last)];
        if (kind == filled[l]) continue;
        const LawParameters& law = contacts.laws[kind];
        store_rows(law, values, l);
        filled[l] = kind;
        lane_dilates[l] = law.dilation_compliance > 0.0;
        lane_weakens[l] = law::weakens(law);
    }
    const auto any = [](const bool* flags) {
        return std::any_of(flags, flags + lanes, [](bool one) { return one; });
    };
    dilating = any(lane_dilates);
    weakening = any(lane_weakens);
}

}  // namespace flexpm
