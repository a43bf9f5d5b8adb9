// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  One block of contacts: relative motion, bilinear law, nodal forces, paper Eqs. 5-19.
#pragma once

#include <flexpm/kernel/assembly.hpp>

namespace flexpm {

/// Parameters of a block's contacts as rows. One for all blocks of a pass: it keeps what it holds for
/// blocks of the same law.
struct LawRows {
    static constexpr int count = sizeof(LawParameters) / sizeof(double), none = -1;
    int filled = none;  ///< index of the law in all lanes
    alignas(64) double values[count * lanes];
};

/// Fill `next_centre` of a block of grains, which contacts read.
void predict_centres(Assembly& a, int block, double dt);

/// Update contact block `block` over a step `dt`, at the positions reached at its end.
void update_contact_block(Assembly& a, int block, double dt, LawRows& law);

/// Update the pressure forces on block `block` of boundary edges; returns their work [J].
double update_edge_block(Assembly& a, int block, double dt);

}  // namespace flexpm
