// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Laws of a block of contacts as rows.
#pragma once

#include <flexpm/kernel/assembly/contacts.hpp>

namespace flexpm {

/// Parameters of a block's contacts as rows. One for all blocks of a pass: it keeps what it holds for
/// blocks of the same law.
struct LawRows {
    static constexpr int none = -1;
    int filled = none;      ///< index of the law in all lanes
    bool dilating = false;  ///< whether a law in a lane dilates
    alignas(64) double values[LawRow::count * lanes];

    void fill(const Contacts& contacts, int block);
};

}  // namespace flexpm
