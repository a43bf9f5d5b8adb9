// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/plane_lanes/element_forces.hpp>

#include <flexpm/kernel/assembly/triangle_rows.hpp>
#include <flexpm/kernel/core/compiler.hpp>
#include <flexpm/kernel/core/instruction_set.hpp>
#include <flexpm/kernel/plane_lanes/prefetch.hpp>

namespace flexpm {

namespace {

/// The elements of a block, and the forces on its nodes.
struct ElementRows {
    int nodes;
    TriangleRows triangles;
    double* force;
    bool prefetches;
};

/// Triangles from the one that is worked on to the one to ask for.
constexpr int prefetch_distance = 12;

/// Ask for the shape of a triangle ahead, and as many nodes of the next block as there are
/// triangles.
FLEXPM_INLINE void prefetch_ahead(const ElementRows& b, int triangle)
{
    if (!b.prefetches) return;
    const int next_node = node_stride * (b.nodes + triangle);
    prefetch_rows(
        b.triangles.shape + shape_rows * lanes * (triangle + prefetch_distance), shape_rows);
    prefetch_rows(b.triangles.displacement + next_node, dimension);
    prefetch_rows(b.force + next_node, dimension);
}

FLEXPM_INLINE void add_forces(const ElementRows& b)
{
    double* f = b.force;
    const TriangleRows& rows = b.triangles;
    for (int t = 0; t < rows.triangles; ++t) {
        const TriangleNodes n = nodes_of(rows, t);
        prefetch_ahead(b, t);
        FLEXPM_INDEPENDENT
        for (int l = 0; l < lanes; ++l) {
            const TriangleForces e = triangle_forces(load_shape(rows.shape, t, l),
                load_rows<PlaneStiffness>(rows.stiffness, l), displacement_of(rows, n.n0, l),
                displacement_of(rows, n.n1, l), displacement_of(rows, n.n2, l));
            f[component(n.n0 + l, 0)] -= e.f1x + e.f2x;
            f[component(n.n0 + l, 1)] -= e.f1y + e.f2y;
            f[component(n.n1 + l, 0)] += e.f1x;
            f[component(n.n1 + l, 1)] += e.f1y;
            f[component(n.n2 + l, 0)] += e.f2x;
            f[component(n.n2 + l, 1)] += e.f2y;
        }
    }
}

}  // namespace

void add_element_forces(Grains& grains, int block, bool prefetches)
{
    variant_of<add_forces>()({ grains.group(block).nodes, triangle_rows(grains, block),
        grains.force.data() + grains.block_nodes[block], prefetches });
}

}  // namespace flexpm
