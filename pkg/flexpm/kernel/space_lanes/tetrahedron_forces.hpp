// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Forces and energy of the tetrahedra of a grain, `lanes` of them at a time.
#pragma once

#include <flexpm/kernel/assembly/solid_state.hpp>
#include <flexpm/kernel/fem/tetrahedron.hpp>

namespace flexpm {

/// Add the forces of all tetrahedra of a block of grains to those on its nodes.
void add_tetrahedron_forces(SolidState& s, int block);

/// Stored in the tetrahedra of all grains [J].
double strain_energy(const SolidState& s);

/// One tetrahedron, for sums. Those of a grain are `lanes` times its batches; padded ones have no
/// volume.
TetrahedronShape tetrahedron_of(const SolidState& s, int batch, int lane);

/// Offsets of its four nodes, the centre first.
std::array<int, 4> tetrahedron_nodes(const SolidState& s, int block, int batch, int lane);

/// Call visit(shape, nodes) for each tetrahedron of a block.
template <class Visit> void for_each_tetrahedron(const SolidState& s, int block, Visit visit)
{
    for (int t = s.tetrahedra.first[block]; t < s.tetrahedra.first[block + 1]; ++t) {
        for (int l = 0; l < lanes; ++l) {
            const TetrahedronShape shape = tetrahedron_of(s, t, l);
            if (shape.volume > 0.0) visit(shape, tetrahedron_nodes(s, block, t, l));
        }
    }
}

}  // namespace flexpm
