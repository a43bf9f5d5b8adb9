// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Triangles of a block of grains as rows, one lane of which is one grain.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>
#include <flexpm/kernel/core/compiler.hpp>

namespace flexpm {

/// The elements of a block and what moves their nodes, [row][lane].
struct TriangleRows {
    int triangles;
    const int* connectivity;
    const double* shape;
    const double* stiffness;
    const double* displacement;
};

inline TriangleRows triangle_rows(const Assembly& a, int block)
{
    const std::vector<int>& nodes = a.group(block).triangles;
    return { static_cast<int>(nodes.size()) / 3, nodes.data(),
        a.shape.data() + a.block_triangles[block], a.stiffness.data() + 3 * lanes * block,
        a.displacement.data() + a.block_nodes[block] };
}

/// The nodes of element `t`, in rows.
struct TriangleNodes {
    int n0, n1, n2;
};

FLEXPM_INLINE TriangleNodes nodes_of(const TriangleRows& b, int t)
{
    const int* n = b.connectivity + 3 * t;
    return { 2 * lanes * n[0], 2 * lanes * n[1], 2 * lanes * n[2] };
}

FLEXPM_INLINE TriangleShape shape_of(const TriangleRows& b, int t, int lane)
{
    const double* s = b.shape + 5 * lanes * t + lane;
    return { s[0], s[lanes], s[2 * lanes], s[3 * lanes], s[4 * lanes] };
}

FLEXPM_INLINE PlaneStiffness stiffness_of(const TriangleRows& b, int lane)
{
    const double* c = b.stiffness + lane;
    return { c[0], c[lanes], c[2 * lanes] };
}

FLEXPM_INLINE Point displacement_of(const TriangleRows& b, int node, int lane)
{
    return { b.displacement[node + lane], b.displacement[node + lanes + lane] };
}

}  // namespace flexpm
