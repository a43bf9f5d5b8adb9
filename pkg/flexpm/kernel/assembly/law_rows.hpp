// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Laws of a block of contacts as rows.
#pragma once

#include <flexpm/kernel/assembly/contacts.hpp>

namespace flexpm {

/// Parameters of a block's contacts as rows. One for all blocks of a pass: a lane keeps what it
/// holds for contacts of the same law.
struct LawRows {
    int filled[lanes];         ///< index of the law in each lane, -1: none
    bool lane_dilates[lanes];  ///< whether that law dilates
    bool lane_weakens[lanes];  ///< whether its friction falls after a crack
    bool dilating = false;     ///< whether any of them dilates
    bool weakening = false;    ///< whether the friction of any of them falls
    alignas(64) double values[law_rows * lanes];

    LawRows();
    void fill(const Contacts& contacts, int block);
};

}  // namespace flexpm
