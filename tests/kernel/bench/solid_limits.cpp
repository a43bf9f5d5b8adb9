// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Limits of a step of a solid: the bandwidth of the memory, and the time to touch the same
/// bytes in the same order without arithmetic. Arithmetic is the step of a specimen that stays in
/// the caches, see solid_bench.cpp.
#include "solid_loaded.hpp"

#include <flexpm/kernel/core/thread_team.hpp>
#include <flexpm/kernel/space_lanes/solid_access.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <numeric>

namespace {

using flexpm::lanes;

/// Far more than caches hold [doubles].
constexpr std::size_t many = std::size_t(1) << 25;

template <class Loop> void share(benchmark::State& state, Loop loop)
{
    const int threads = static_cast<int>(state.range(0));
    flexpm::ThreadTeam& team = flexpm::team_of(threads);
    for (auto _ : state)
        team.run([&](int t) { loop(many * t / threads, many * (t + 1) / threads); });
}

void memory_read(benchmark::State& state)
{
    const flexpm::Array<double> values(many, 1.0);
    share(state, [&](std::size_t i, std::size_t end) {
        double sums[lanes] = {};
        for (; i + lanes <= end; i += lanes)
            for (int l = 0; l < lanes; ++l)
                sums[l] += values[i + l];
        benchmark::DoNotOptimize(std::accumulate(sums, sums + lanes, 0.0));
    });
    state.SetBytesProcessed(state.iterations() * many * sizeof(double));
}
BENCHMARK(memory_read)->Arg(1)->Arg(2)->ArgName("threads")->UseRealTime();

void memory_copy(benchmark::State& state)
{
    const flexpm::Array<double> from(many, 1.0);
    flexpm::Array<double> to(many, 0.0);
    share(state, [&](std::size_t i, std::size_t end) {
        std::copy(from.begin() + i, from.begin() + end, to.begin() + i);
        benchmark::ClobberMemory();
    });
    state.SetBytesProcessed(state.iterations() * 2 * many * sizeof(double));
}
BENCHMARK(memory_copy)->Arg(1)->Arg(2)->ArgName("threads")->UseRealTime();

/// Touches each line of an array's part once, and counts its bytes.
class Touch {
public:
    double read = 0.0, written = 0.0;  ///< [B]

    template <class T> void reads(const T* first, std::size_t count)
    {
        read += count * sizeof(T);
        const auto* line = reinterpret_cast<const volatile char*>(first);
        for (std::size_t i = 0; i < count * sizeof(T); i += 64)
            sum_ += line[i];
    }
    /// Read and written again.
    template <class T> void changes(T* first, std::size_t count)
    {
        read += count * sizeof(T);
        written += count * sizeof(T);
        auto* line = reinterpret_cast<volatile char*>(first);
        for (std::size_t i = 0; i < count * sizeof(T); i += 64)
            line[i] = static_cast<char>(line[i] + 1);
    }

private:
    int sum_ = 0;
};

/// Read and write the bytes that an elastic step needs of a block of contacts. Afterwards the
/// written numbers mean nothing, as those of touch_grain().
void touch_contacts(flexpm::SolidState& s, int block, Touch& to)
{
    const flexpm::FaceContacts& c = s.contacts;
    if (s.is_rigid()) {
        to.reads(s.plan.face_grains.data() + 2 * block * lanes, 2 * lanes);
        to.reads(s.plan.faces.data() + flexpm::SolidPlan::first_face(block),
            flexpm::RigidFaceRow::count * lanes);
    } else {
        const int nodes = c.block_nodes[block], corners = c.group_in(block).corners;
        to.reads(c.nodes.data() + nodes, 2 * corners * lanes);
        to.reads(c.areas.data() + c.block_points[block], c.group_in(block).points * lanes);
        to.reads(c.shares.data() + c.block_shares[block],
            c.block_shares[block + 1] - c.block_shares[block]);
    }
    if (s.plan.first_parcel[block] >= 0) {
        const int rows =
            s.is_rigid() ? 2 * flexpm::WrenchRow::count : 2 * 4 * c.group_in(block).corners;
        to.changes(s.plan.parcels.data() + s.plan.first_parcel[block], rows * lanes);
    }
}

void touch_grain(flexpm::SolidState& s, int block, Touch& to)
{
    flexpm::Grains& g = s.grains;
    int first = g.block_nodes[block];
    int values = g.group(block).nodes * g.layout.node_stride;
    if (s.is_rigid()) {
        const auto [grain, centre] = s.plan.body_places[block];
        first = centre;
        values = g.layout.node_stride;
        to.changes(&s.bodies[grain], 1);
        to.changes(s.plan.motions.data() + block * flexpm::RigidMotionRow::count,
            flexpm::RigidMotionRow::count);
        to.changes(
            s.plan.wrenches.data() + block * flexpm::WrenchRow::count, flexpm::WrenchRow::count);
    } else {
        const int batch = s.tetrahedra.first[block], end = s.tetrahedra.first[block + 1];
        to.reads(s.tetrahedra.nodes.data() + batch * flexpm::Tetrahedra::corners * lanes,
            (end - batch) * flexpm::Tetrahedra::corners * lanes);
        to.reads(s.tetrahedra.shape.data() + batch * flexpm::Tetrahedra::rows * lanes,
            (end - batch) * flexpm::Tetrahedra::rows * lanes);
    }
    for (auto* changed : { &g.displacement, &g.velocity, &g.force })
        to.changes(changed->data() + first, values);
    to.reads(s.undamped().velocity.data() + first, values);
    to.reads(g.inverse_mass.data() + g.scalar_index(first), values / g.layout.node_stride);
    to.reads(g.prescribed.data() + first, values);
}

void solid_bytes(benchmark::State& state)
{
    flexpm::SolidState s = loaded::cube(static_cast<int>(state.range(0)), state.range(1) != 0);
    loaded::strain(s, -1e-12, 0.0);
    flexpm::step(s, {});
    Touch all;
    for (auto _ : state) {
        Touch to;
        for (int tile = 0; tile < s.plan.tiles(); ++tile) {
            for (int b = s.plan.tile_contacts[tile]; b < s.plan.tile_contacts[tile + 1]; ++b)
                touch_contacts(s, b, to);
            const int end = std::min((tile + 1) * flexpm::tile_grains, s.grains.blocks());
            for (int b = tile * flexpm::tile_grains; b < end; ++b)
                touch_grain(s, b, to);
        }
        all = to;
    }
    const double grains = s.grains.count;
    state.counters["per grain"] = benchmark::Counter(
        grains, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    state.counters["read"] = all.read / grains;
    state.counters["written"] = all.written / grains;
}
BENCHMARK(solid_bytes)
    ->Args({ 12, 0 })
    ->Args({ 23, 0 })
    ->Args({ 46, 0 })
    ->Args({ 12, 1 })
    ->Args({ 23, 1 })
    ->Args({ 46, 1 })
    ->ArgNames({ "along", "rigid" });

}  // namespace
