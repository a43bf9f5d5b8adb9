// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Triangles of a block of grains as rows, one lane of which is one grain.
#pragma once

#include <flexpm/kernel/assembly/grains.hpp>
#include <flexpm/kernel/core/member_rows.hpp>
#include <flexpm/kernel/fem/triangle.hpp>

namespace flexpm {

/// Rows of a triangle and of the elastic stiffness of a grain.
constexpr int shape_rows = row_count<TriangleShape>;
constexpr int stiffness_rows = row_count<PlaneStiffness>;

FLEXPM_INLINE TriangleShape load_shape(const double* rows, int triangle, int lane)
{
    return load_rows<TriangleShape>(rows + shape_rows * lanes * triangle, lane);
}

/// The elements of a block and what moves their nodes, [row][lane].
struct TriangleRows {
    int triangles;
    const int* connectivity;
    const double* shape;
    const double* stiffness;
    const double* displacement;
};

inline TriangleRows triangle_rows(const Grains& grains, int block)
{
    const MeshGroup& group = grains.group(block);
    return { group.triangle_count(), group.triangles.data(),
        grains.shape.data() + grains.block_triangles[block],
        grains.stiffness.data() + stiffness_rows * lanes * block,
        grains.displacement.data() + grains.block_nodes[block] };
}

/// The nodes of element `t`, in rows.
struct TriangleNodes {
    int n0, n1, n2;
};

FLEXPM_INLINE TriangleNodes nodes_of(const TriangleRows& b, int t)
{
    const int* n = b.connectivity + 3 * t;
    return { node_stride * n[0], node_stride * n[1], node_stride * n[2] };
}

FLEXPM_INLINE Point displacement_of(const TriangleRows& b, int node, int lane)
{
    return { b.displacement[component(node + lane, 0)], b.displacement[component(node + lane, 1)] };
}

}  // namespace flexpm
