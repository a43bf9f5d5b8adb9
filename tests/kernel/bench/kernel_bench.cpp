// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Micro-benchmarks on a specimen of the paper's size: contact blocks alone, grain blocks
/// alone, the whole step. Wall times a machine with other work to do are worth nothing: compare in
/// turns (--benchmark_repetitions, --benchmark_enable_random_interleaving=true).
#include "loaded.hpp"

#include <flexpm/kernel/plane_lanes/centre_motion.hpp>
#include <flexpm/kernel/plane_lanes/contact_forces.hpp>

#include <benchmark/benchmark.h>

namespace {

constexpr double slow = -1e-10;  // no point leaves its elastic branch in as many steps as are timed

const specimens::Specimen& paper_size()
{
    static const specimens::Specimen s = specimens::random_grains(0.08, 0.16, 2.8e-3, 1);
    return s;
}

void count(benchmark::State& state, double items, const char* name)
{
    state.counters[std::string("per ") + name] = benchmark::Counter(
        items, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void contact_blocks(benchmark::State& state)
{
    flexpm::Assembly a = specimens::assemble(
        paper_size(), loaded::options("refined", static_cast<int>(state.range(0))));
    loaded::load(a, slow);
    loaded::run(a, 50);
    for (auto _ : state) {
        for (int b = 0; b < a.grains.blocks(); ++b)
            flexpm::predict_centres(a.grains, b, 1e-6, a.plan.next_centre);
        flexpm::update_contact_blocks(a, 0, a.contacts.blocks(), 1e-6);
    }
    count(state, a.contacts.count, "contact");
}
BENCHMARK(contact_blocks)->Arg(1)->Arg(2)->Arg(3)->ArgName("points");

/// Whole steps of grains without contacts.
void grain_blocks(benchmark::State& state, const char* kind)
{
    specimens::Specimen s = paper_size();
    s.cells.shared_edges.clear();
    flexpm::Assembly a = specimens::assemble(s, loaded::options(kind));
    loaded::drive(a, slow);
    for (auto _ : state)
        flexpm::step(a, flexpm::StepOptions());
    count(state, a.grains.count, "grain");
}
BENCHMARK_CAPTURE(grain_blocks, fan, "fan");
BENCHMARK_CAPTURE(grain_blocks, refined, "refined");
BENCHMARK_CAPTURE(grain_blocks, rigid, "rigid");

void whole_step(benchmark::State& state, const char* kind)
{
    flexpm::Assembly a = specimens::assemble(paper_size(), loaded::options(kind));
    loaded::load(a, slow);
    loaded::run(a, 50);
    flexpm::StepOptions o;
    o.threads = static_cast<int>(state.range(0));
    for (auto _ : state)
        flexpm::step(a, o);
    count(state, a.grains.count, "grain");
}
BENCHMARK_CAPTURE(whole_step, fan, "fan")->Arg(1)->ArgName("threads");
BENCHMARK_CAPTURE(whole_step, refined, "refined")
    ->Arg(1)
    ->Arg(2)
    ->ArgName("threads")
    ->UseRealTime();
BENCHMARK_CAPTURE(whole_step, rigid, "rigid")->Arg(1)->ArgName("threads");

}  // namespace
