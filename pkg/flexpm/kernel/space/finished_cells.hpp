// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  From cells whose faces are known to numbered ones, whatever the cells were made of.
#pragma once

#include <flexpm/kernel/space/cell_complex.hpp>
#include <flexpm/kernel/space/polyhedra.hpp>

namespace flexpm {

/// Length over the mean diameter below which vertices are one.
constexpr double zero_edge = 1e-9;

/// Check a limit of edges.
/// @throws std::invalid_argument  unless finite and >= 0
void require_short_edge(double short_edge);

/// Collapse short edges, number cells without the hidden ones, and vertices in the order in which
/// faces use them; add volumes between the triangles of the faces, which a collapse has bent.
///
/// @param p        knows its hidden spheres
/// @param centres  per cell, hidden ones too, the common corner of its tetrahedra
/// @param short_edge  edges below this length are collapsed [m]
void finish_cells(Polyhedra& p, CellComplex& complex, const std::vector<Vector>& centres,
    double short_edge);

}  // namespace flexpm
