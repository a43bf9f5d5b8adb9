// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Laguerre cells of spheres, weight R^2, as they are before walls cut them.
#pragma once

#include <flexpm/kernel/space/cell_complex.hpp>
#include <flexpm/kernel/space/solid.hpp>

#include <vector>

namespace flexpm {

/// Laguerre cells of spheres, closed by far points around the solid: outside it they are not to be
/// used. Where five or more cells meet in one point, or four along a line, edges and faces as small
/// as round-off remain; see merge_close_vertices().
///
/// Vertices are right to 1e-12 of the spacing also where the spheres stand in a lattice: centres of
/// flat tetrahedra are found in exact numbers.
///
/// A sphere that others hide has no face.
///
/// @param spheres  sound, with their centres in the solid, no two of them in one place
CellComplex power_cells(const std::vector<Sphere>& spheres, const Solid& solid);

}  // namespace flexpm
