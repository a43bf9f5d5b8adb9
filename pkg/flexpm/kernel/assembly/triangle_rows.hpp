// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Triangles of a block of grains as rows, one lane of which is one grain.
#pragma once

#include <flexpm/kernel/assembly/grains.hpp>
#include <flexpm/kernel/fem/triangle.hpp>

namespace flexpm {

/// Rows of a triangle, the members of TriangleShape.
struct ShapeRow {
    enum : int { g1x, g1y, g2x, g2y, volume, count };
};

/// Rows of the elastic stiffness of a block, the members of PlaneStiffness.
struct StiffnessRow {
    enum : int { normal, cross, shear, count };
};

static_assert(sizeof(TriangleShape) == ShapeRow::count * sizeof(double), "a row for each member");
static_assert(
    sizeof(PlaneStiffness) == StiffnessRow::count * sizeof(double), "a row for each member");

FLEXPM_INLINE TriangleShape load_shape(const double* rows, int triangle, int lane)
{
    const double* r = rows + ShapeRow::count * lanes * triangle + lane;
    return { r[ShapeRow::g1x * lanes], r[ShapeRow::g1y * lanes], r[ShapeRow::g2x * lanes],
        r[ShapeRow::g2y * lanes], r[ShapeRow::volume * lanes] };
}

inline void store_shape(const TriangleShape& s, double* rows, int triangle, int lane)
{
    double* r = rows + ShapeRow::count * lanes * triangle + lane;
    r[ShapeRow::g1x * lanes] = s.g1x;
    r[ShapeRow::g1y * lanes] = s.g1y;
    r[ShapeRow::g2x * lanes] = s.g2x;
    r[ShapeRow::g2y * lanes] = s.g2y;
    r[ShapeRow::volume * lanes] = s.volume;
}

FLEXPM_INLINE PlaneStiffness load_stiffness(const double* rows, int lane)
{
    const double* r = rows + lane;
    return { r[StiffnessRow::normal * lanes], r[StiffnessRow::cross * lanes],
        r[StiffnessRow::shear * lanes] };
}

inline void store_stiffness(const PlaneStiffness& c, double* rows, int lane)
{
    double* r = rows + lane;
    r[StiffnessRow::normal * lanes] = c.normal;
    r[StiffnessRow::cross * lanes] = c.cross;
    r[StiffnessRow::shear * lanes] = c.shear;
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
        grains.stiffness.data() + StiffnessRow::count * lanes * block,
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
