// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Whether cells are closed.
#pragma once

#include "support/sphere_samples.hpp"

namespace flexpm_test {

/// Edges of cells that are not in two faces of theirs, once each way.
inline int loose_edges(const Polyhedra& cells)
{
    int wrong = 0;
    std::map<std::array<int, 3>, int> edges;
    for (std::size_t f = 0; f < cells.faces.size(); ++f) {
        const auto corners = cells.corners(static_cast<int>(f));
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const int u = corners[k], v = corners[(k + 1) % corners.size()];
            wrong += edges[{ cells.faces[f].cell_a, u, v }]++;
            if (cells.faces[f].cell_b >= 0) wrong += edges[{ cells.faces[f].cell_b, v, u }]++;
        }
    }
    for (const auto& [edge, times] : edges)
        wrong += edges.count({ edge[0], edge[2], edge[1] }) != 1;
    return wrong;
}

}  // namespace flexpm_test
