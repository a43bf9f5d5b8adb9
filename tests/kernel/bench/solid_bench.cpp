// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Micro-benchmarks of specimens in space: faces alone, tetrahedra alone, the whole step,
/// elastic and with softening points.
#include "solid_loaded.hpp"

#include <flexpm/kernel/space_lanes/face_forces.hpp>
#include <flexpm/kernel/space_lanes/tetrahedron_forces.hpp>

#include <benchmark/benchmark.h>

namespace {

constexpr double slow = -1e-12;  ///< strain of a step in which no point leaves its elastic branch

flexpm::SolidState strained(int along, double rate, bool rigid = false)
{
    flexpm::SolidState s = loaded::cube(along, rigid);
    loaded::strain(s, rate, 0.0);
    return s;
}

void count(benchmark::State& state, const flexpm::SolidState& s)
{
    state.counters["per grain"] = benchmark::Counter(s.grains.count,
        benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void solid_faces(benchmark::State& state)
{
    flexpm::SolidState s = strained(static_cast<int>(state.range(0)), slow);
    for (auto _ : state)
        flexpm::update_face_blocks(s, 0, s.contacts.blocks(), 0.0);
    count(state, s);
}
BENCHMARK(solid_faces)->Arg(6)->Arg(12)->ArgName("along");

void solid_tetrahedra(benchmark::State& state)
{
    flexpm::SolidState s = strained(static_cast<int>(state.range(0)), slow);
    for (auto _ : state) {
        for (int b = 0; b < s.grains.blocks(); ++b)
            flexpm::add_tetrahedron_forces(s, b);
    }
    count(state, s);
}
BENCHMARK(solid_tetrahedra)->Arg(6)->Arg(12)->ArgName("along");

void solid_step(benchmark::State& state)
{
    flexpm::SolidState s = strained(static_cast<int>(state.range(0)), slow);
    flexpm::StepOptions o;
    o.threads = static_cast<int>(state.range(1));
    for (auto _ : state)
        flexpm::step(s, o);
    count(state, s);
}
BENCHMARK(solid_step)
    ->Args({ 4, 1 })
    ->Args({ 6, 1 })
    ->Args({ 12, 1 })
    ->Args({ 12, 2 })
    ->Args({ 23, 1 })
    ->Args({ 23, 2 })
    ->Args({ 46, 1 })
    ->Args({ 46, 2 })
    ->ArgNames({ "along", "threads" })
    ->UseRealTime();

void solid_rigid_step(benchmark::State& state)
{
    flexpm::SolidState s = strained(static_cast<int>(state.range(0)), slow, true);
    flexpm::StepOptions o;
    o.leave_nodes = true;
    for (auto _ : state)
        flexpm::step(s, o);
    count(state, s);
}
BENCHMARK(solid_rigid_step)->Arg(4)->Arg(12)->Arg(23)->Arg(46)->ArgName("along");

/// Pressed up to where most contacts have a point past its elastic branch.
void solid_softening(benchmark::State& state)
{
    flexpm::SolidState s = strained(static_cast<int>(state.range(0)), -1e-6);
    for (int k = 0; k < 3000; ++k)
        flexpm::step(s, {});
    for (auto _ : state)
        flexpm::step(s, {});
    count(state, s);
}
BENCHMARK(solid_softening)->Arg(6)->ArgName("along");

}  // namespace
