// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/space_lanes/tetrahedron_forces.hpp>

#include <flexpm/kernel/core/instruction_set.hpp>
#include <flexpm/kernel/core/lane_sum.hpp>
#include <flexpm/kernel/core/prefetch_rows.hpp>
#include <flexpm/kernel/core/rows_of_four.hpp>

namespace flexpm {

namespace {

/// Batches from asking for one until it is used, of the next grain, too: they follow each other.
constexpr int ahead = 2;

/// The tetrahedra of a grain and its nodes.
struct TetrahedronRows {
    int batches;
    int centre;  ///< offset from the grain's first node
    const int* nodes;
    const double* shape;
    const double* stiffness;
    const double* displacement;
    double* force;
};

FLEXPM_INLINE TetrahedronShape load_tetrahedron(const double* rows, int l)
{
    const auto row = [&](int r) FLEXPM_INLINED { return rows[r * lanes + l]; };
    return { { row(0), row(1), row(2) }, { row(3), row(4), row(5) }, { row(6), row(7), row(8) },
        row(9) };
}

/// Displacements of corners 1 to 3, [corner][component][lane].
template <bool Wide>
FLEXPM_INLINE void gather_corners(const TetrahedronRows& b, const int* nodes, double* to)
{
    for (int k = 0; k < Tetrahedra::corners; ++k) {
        const int* node = nodes + k * lanes;
        to_lanes<Wide>([&](int l, Four& row)
                           FLEXPM_INLINED { row = row_of_four(b.displacement + node[l]); },
            to + k * vector_rows);
    }
}

/// Adds to one node after the other, since lanes may share it.
FLEXPM_INLINE void scatter_corners(const TetrahedronRows& b, const int* nodes, const double* force)
{
    for (int k = 0; k < Tetrahedra::corners; ++k) {
        from_lanes(force + k * vector_rows, [&](int l, const Four& f) FLEXPM_INLINED {
            row_of_four(b.force + nodes[k * lanes + l]) += f;
        });
    }
}

template <bool Wide> FLEXPM_INLINE void add_forces(const TetrahedronRows& b)
{
    constexpr int values = Tetrahedra::corners * vector_rows;
    alignas(64) double way[values], force[values], on_corners[vector_rows];
    for (int i = 0; i < vector_rows; ++i)
        on_corners[i] = 0.0;
    const double* at = b.displacement + b.centre;
    const Vector centre { at[0], at[1], at[2] };
    for (int t = 0; t < b.batches; ++t) {
        const int* nodes = b.nodes + t * Tetrahedra::corners * lanes;
        const double* shape = b.shape + t * Tetrahedra::rows * lanes;
        prefetch_rows(nodes + ahead * Tetrahedra::corners * lanes, Tetrahedra::corners);
        prefetch_rows(shape + ahead * Tetrahedra::rows * lanes, Tetrahedra::rows);
        gather_corners<Wide>(b, nodes, way);
        FLEXPM_INDEPENDENT
        for (int l = 0; l < lanes; ++l) {
            const TetrahedronForces f = tetrahedron_forces(load_tetrahedron(shape, l),
                load_rows<PlaneStiffness>(b.stiffness, l), centre, load_vector(way, l),
                load_vector(way + vector_rows, l), load_vector(way + 2 * vector_rows, l));
            store_vector(f.f1, force, l);
            store_vector(f.f2, force + vector_rows, l);
            store_vector(f.f3, force + 2 * vector_rows, l);
            store_vector(load_vector(on_corners, l) + (f.f1 + f.f2 + f.f3), on_corners, l);
        }
        scatter_corners(b, nodes, force);
    }
    // minus all on the centre
    Four sum {};
    from_lanes(on_corners, [&](int, const Four& f) FLEXPM_INLINED { sum += f; });
    row_of_four(b.force + b.centre) -= sum;
}

template <bool Wide> FLEXPM_INLINE void add_strain(const TetrahedronRows& b, LaneSum& energy)
{
    LaneSum sum = energy;
    alignas(64) double way[Tetrahedra::corners * vector_rows];
    const double* at = b.displacement + b.centre;
    const Vector centre { at[0], at[1], at[2] };
    for (int t = 0; t < b.batches; ++t) {
        const double* shape = b.shape + t * Tetrahedra::rows * lanes;
        gather_corners<Wide>(b, b.nodes + t * Tetrahedra::corners * lanes, way);
        FLEXPM_INDEPENDENT
        for (int l = 0; l < lanes; ++l) {
            sum.lane[l] += tetrahedron_energy(load_tetrahedron(shape, l),
                load_rows<PlaneStiffness>(b.stiffness, l), centre, load_vector(way, l),
                load_vector(way + vector_rows, l), load_vector(way + 2 * vector_rows, l));
        }
    }
    energy = sum;
}

TetrahedronRows tetrahedron_rows(const SolidState& s, int block, double* force)
{
    const Grains& grains = s.grains;
    const int first = grains.block_nodes[block], batch = s.tetrahedra.first[block];
    return { s.tetrahedra.first[block + 1] - batch,
        grains.layout.node_stride * grains.group(block).vertices,
        s.tetrahedra.nodes.data() + batch * Tetrahedra::corners * lanes,
        s.tetrahedra.shape.data() + batch * Tetrahedra::rows * lanes,
        grains.stiffness.data() + block * row_count<PlaneStiffness> * lanes,
        grains.displacement.data() + first, force };
}

}  // namespace

double strain_energy(const SolidState& s)
{
    LaneSum sum;
    const auto add = variant_of<add_strain<false>, add_strain<true>>();
    for (int block = 0; block < s.grains.blocks(); ++block)
        if (!s.grains.group(block).rigid) add(tetrahedron_rows(s, block, nullptr), sum);
    return sum.total();
}

void add_tetrahedron_forces(SolidState& s, int block)
{
    variant_of<add_forces<false>, add_forces<true>>()(
        tetrahedron_rows(s, block, s.grains.force.data() + s.grains.block_nodes[block]));
}

TetrahedronShape tetrahedron_of(const SolidState& s, int batch, int lane)
{
    return load_tetrahedron(&s.tetrahedra.shape[batch * Tetrahedra::rows * lanes], lane);
}

std::array<int, 4> tetrahedron_nodes(const SolidState& s, int block, int batch, int lane)
{
    const int first = s.grains.block_nodes[block];
    std::array<int, 4> nodes { first
        + s.grains.layout.node_stride * s.grains.group(block).vertices };
    for (int k = 0; k < Tetrahedra::corners; ++k) {
        nodes[k + 1] = first + s.tetrahedra.nodes[(batch * Tetrahedra::corners + k) * lanes + lane];
    }
    return nodes;
}

}  // namespace flexpm
