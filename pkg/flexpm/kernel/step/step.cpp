// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Grains, `lanes` at a time, and the step as a whole.
#include <flexpm/kernel/step/step.hpp>

#include <flexpm/kernel/assembly/triangle_rows.hpp>
#include <flexpm/kernel/core/compiler.hpp>
#include <flexpm/kernel/core/instruction_set.hpp>
#include <flexpm/kernel/forces/contact_forces.hpp>
#include <flexpm/kernel/forces/gravity.hpp>
#include <flexpm/kernel/forces/nodal_forces.hpp>
#include <flexpm/kernel/forces/plate_contact.hpp>
#include <flexpm/kernel/forces/prefetch.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/motion/central_difference.hpp>
#include <flexpm/kernel/motion/centre_motion.hpp>
#include <flexpm/kernel/motion/rigid_grain.hpp>
#include <flexpm/kernel/step/step_plan.hpp>
#include <flexpm/kernel/step/tiles.hpp>

#include <algorithm>
#include <cmath>

#include <omp.h>

namespace flexpm {

namespace {

/// The rows of one block of grains.
struct Rows {
    int nodes;
    TriangleRows triangles;
    double* displacement;
    double* velocity;
    double* force;
    const std::uint8_t* held;
    const double* inverse_mass;
    bool fetch;  ///< ask for what comes after, which is no longer in a cache
};

/// Triangles from the one that is worked on to the one to ask for.
constexpr int triangles_ahead = 12;

/// Ask for the shape of a triangle ahead, and as many nodes of the next block as there are triangles.
FLEXPM_INLINE void fetch_ahead(const Rows& b, int triangle)
{
    if (!b.fetch) return;
    fetch_rows(b.triangles.shape + 5 * lanes * (triangle + triangles_ahead), 5);
    fetch_rows(b.displacement + 2 * lanes * (b.nodes + triangle), 2);
    fetch_rows(b.force + 2 * lanes * (b.nodes + triangle), 2);
}

/// Move the nodes, then add the forces of the elements to `force`.
FLEXPM_INLINE void move_and_deform(const Rows& b, double dt)
{
    double* f = b.force;
    for (int i = 0; i < 2 * lanes * b.nodes; ++i)
        b.displacement[i] += dt * b.velocity[i];
    const TriangleRows& rows = b.triangles;
    for (int t = 0; t < rows.triangles; ++t) {
        const TriangleNodes n = nodes_of(rows, t);
        fetch_ahead(b, t);
        FLEXPM_INDEPENDENT
        for (int l = 0; l < lanes; ++l) {
            const TriangleForces e = triangle_forces(shape_of(rows, t, l), stiffness_of(rows, l),
                displacement_of(rows, n.n0, l), displacement_of(rows, n.n1, l),
                displacement_of(rows, n.n2, l));
            f[n.n0 + l] -= e.f1x + e.f2x;
            f[n.n0 + lanes + l] -= e.f1y + e.f2y;
            f[n.n1 + l] += e.f1x;
            f[n.n1 + lanes + l] += e.f1y;
            f[n.n2 + l] += e.f2x;
            f[n.n2 + lanes + l] += e.f2y;
        }
    }
}

bool holds_any(const Rows& b)
{
    std::uint8_t any = 0;
    for (int i = 0; i < 2 * lanes * b.nodes; ++i)
        any |= b.held[i];
    return any != 0;
}

/// Few blocks lie on a boundary: all others are integrated without looking at `held`. Bytes and
/// doubles in one loop are not vectorised, hence the copy; the sums are a local, which no row aliases.
template <bool Measure, bool Held>
FLEXPM_INLINE void integrate_lanes(const Rows& b, double dt, double damping, StepSums& total)
{
    StepSums sums;
    for (int n = 0; n < b.nodes; ++n) {
        const double* f = b.force + 2 * n * lanes;
        double* v = b.velocity + 2 * n * lanes;
        const double* inverse_mass = b.inverse_mass + n * lanes;
        alignas(64) double held[2 * lanes] = {};
        if (Held) std::copy_n(b.held + 2 * n * lanes, 2 * lanes, held);
        FLEXPM_INDEPENDENT
        for (int l = 0; l < lanes; ++l) {
            const int y = lanes + l;
            integrate_one<Measure, Held>(
                f[l], held[l], inverse_mass[l], 1.0, dt, damping, v[l], sums, l);
            integrate_one<Measure, Held>(
                f[y], held[y], inverse_mass[l], 1.0, dt, damping, v[y], sums, l);
        }
    }
    sums.copy_to(total);
}

template <bool Measure>
FLEXPM_INLINE void integrate_block(const Rows& b, double dt, double damping, StepSums& sums)
{
    if (holds_any(b)) {
        integrate_lanes<Measure, true>(b, dt, damping, sums);
    } else {
        integrate_lanes<Measure, false>(b, dt, damping, sums);
    }
}

double sum(const double* values)
{
    double total = 0.0;
    for (int l = 0; l < lanes; ++l)
        total += values[l];
    return total;
}

void show_positions(Assembly& a, int first, int count)
{
    for (int i = first; i < first + count; ++i) {
        a.shown_position[i] = a.reference[i] + a.displacement[i];
    }
}

void update_deformable(Assembly& a, int block, const StepOptions& options, StepSums& sums)
{
    const int first = a.block_nodes[block];
    const MeshGroup& group = a.group(block);
    const Rows rows = { group.nodes, triangle_rows(a, block), a.displacement.data() + first,
        a.velocity.data() + first, a.force.data() + first, a.held.data() + first,
        a.inverse_mass.data() + first / 2, exceeds_caches(a) };
    variant_of<move_and_deform>()(rows, options.dt);
    const auto integrate = options.measure ? variant_of<integrate_block<true>>()
                                           : variant_of<integrate_block<false>>();
    integrate(rows, options.dt, options.damping, sums);
}

void update_rigid(Assembly& a, int block, const StepOptions& options, StepSums& sums)
{
    step_rigid(rigid_rows(a, block), options.dt, options.damping, options.measure, sums);
}

void update_grain_block(Assembly& a, int block, const StepOptions& options)
{
    const int first = a.block_nodes[block];
    const MeshGroup& group = a.group(block);
    gather_forces(a, block);
    if (a.gravity.x != 0.0 || a.gravity.y != 0.0) add_weight(a, block);
    StepSums sums;
    (group.rigid ? update_rigid : update_deformable)(a, block, options, sums);

    if (!a.shown_position.empty()) show_positions(a, first, 2 * lanes * group.nodes);

    double* damped = a.damping_work.data() + 2 * block;
    double* driven = a.driven_work.data() + 2 * block;
    damped[0] += damped[1] + sum(sums.damped);
    damped[1] = sum(sums.damped_next);
    driven[0] += driven[1] + sum(sums.driven);
    driven[1] = sum(sums.driven_next);
    if (options.measure) {
        a.kinetic[block] = sum(sums.kinetic);
        a.largest_force[block] = *std::max_element(sums.largest, sums.largest + lanes);
    }
}

/// Chunks of one thread.
struct ChunkRange {
    int first, end;
};

ChunkRange share_of(const Assembly& a, int thread, int threads)
{
    return { thread * a.chunks() / threads, (thread + 1) * a.chunks() / threads };
}

void update_contacts(Assembly& a, int chunk, double dt)
{
    const int first = chunk * chunk_length;
    update_contact_blocks(a, first, std::min(first + chunk_length, a.contact_blocks()), dt);
}

/// Calls visit(block) for the blocks of grains that have their last contact in a chunk.
template <class Visitor> void visit_grains(const Assembly& a, int chunk, Visitor&& visit)
{
    for (int i = a.chunk_first[chunk]; i < a.chunk_first[chunk + 1]; ++i)
        visit(a.chunk_blocks[i]);
}

/// The contacts of a thread and the grains that only these contacts touch.
void update_chunks(Assembly& a, ChunkRange own, const StepOptions& options)
{
    for (int chunk = own.first; chunk < own.end; ++chunk) {
        update_contacts(a, chunk, options.dt);
        visit_grains(a, chunk, [&](int block) {
            if (a.first_chunk[block] >= own.first) update_grain_block(a, block, options);
        });
    }
}

/// The grains that contacts of an earlier thread touch, too.
void update_shared_grains(Assembly& a, ChunkRange own, const StepOptions& options)
{
    for (int chunk = own.first; chunk < own.end; ++chunk) {
        visit_grains(a, chunk, [&](int block) {
            if (a.first_chunk[block] < own.first) update_grain_block(a, block, options);
        });
    }
}

/// What a step needs besides a saved state.
void make_ready(Assembly& a)
{
    a.next_centre.resize(static_cast<std::size_t>(2 * lanes * a.blocks()));
    if (a.source_pairs.empty()) prepare_step(a);  // loaded
}

}  // namespace

void show_positions(Assembly& a)
{
    a.shown_position.resize(a.reference.size());
    show_positions(a, 0, static_cast<int>(a.reference.size()));
}

void step(Assembly& a, const StepOptions& options)
{
    const int blocks = a.blocks();
    make_ready(a);
#pragma omp parallel num_threads(options.threads) if (options.threads > 1)
    {
#pragma omp for schedule(static)
        for (int b = 0; b < blocks; ++b)
            predict_centres(a, b, options.dt);
#pragma omp single
        {
            for (int b = 0; b < a.edge_blocks(); ++b) {
                a.pressure_work += update_edge_block(a, b, options.dt);
            }
            update_plates(a, options.dt, options.damping);
        }
        const ChunkRange own = share_of(a, omp_get_thread_num(), omp_get_num_threads());
        update_chunks(a, own, options);
#pragma omp barrier
        update_shared_grains(a, own, options);
    }
    ++a.step;
}

}  // namespace flexpm
