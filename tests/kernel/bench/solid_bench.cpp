// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Micro-benchmarks of specimens in space: faces alone, tetrahedra alone, the whole step,
/// elastic and with softening points.
#include <flexpm/kernel/core/random.hpp>
#include <flexpm/kernel/solids/face_forces.hpp>
#include <flexpm/kernel/solids/solid_build.hpp>
#include <flexpm/kernel/solids/solid_loading.hpp>
#include <flexpm/kernel/solids/solid_masses.hpp>
#include <flexpm/kernel/solids/solid_step.hpp>
#include <flexpm/kernel/solids/tetrahedron_forces.hpp>

#include "support/specimens.hpp"

#include <benchmark/benchmark.h>

namespace {

constexpr double size = 3e-3;    ///< of a grain [m]
constexpr double slow = -1e-12;  ///< strain of a step in which no point leaves its elastic branch
constexpr double damping = 0.7;

/// A cube of so many grains along each edge, whose centres are strewn about a lattice, strained by
/// `rate` in each step as a whole.
flexpm::SolidState cube(int along, double rate)
{
    flexpm::Random random(1);
    const auto place = [&](int k) { return size * (k + 0.5 + 0.5 * (random.next() - 0.5)); };
    std::vector<flexpm::Sphere> spheres;
    for (int k = 0; k < along * along * along; ++k) {
        const double x = place(k % along), y = place(k / along % along),
                     z = place(k / along / along);
        spheres.push_back({ { x, y, z }, 0.5 * size * (0.8 + 0.4 * random.next()) });
    }
    const auto solid = flexpm::Solid::box(along * size, along * size, along * size);
    flexpm::SolidState s =
        flexpm::make_solid(flexpm::polyhedra(spheres, solid, { 0.1 * size, false }), solid,
            { { specimens::granite() }, { specimens::granite_contact() }, {},
                flexpm::FacePointRule::corners_and_inner });
    flexpm::scale_masses(s, damping);
    flexpm::SolidField field;
    flexpm::for_each_node(s, [&](int grain, int number) {
        const auto p = flexpm::space_vector(s.grains.reference, s.grains.node(grain, number));
        field.ways.push_back({ -0.2 * p.x, -0.2 * p.y, p.z });
    });
    for (const auto side : { flexpm::SolidSide::bottom, flexpm::SolidSide::top })
        flexpm::prescribe(s, flexpm::side_nodes(s, side), 2, 0.0);
    flexpm::begin_from(s, field, 0.0, rate);
    return s;
}

void count(benchmark::State& state, const flexpm::SolidState& s)
{
    state.counters["per grain"] = benchmark::Counter(s.grains.count,
        benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void solid_faces(benchmark::State& state)
{
    flexpm::SolidState s = cube(static_cast<int>(state.range(0)), slow);
    for (auto _ : state)
        flexpm::update_face_blocks(s, 0, s.contacts.blocks());
    count(state, s);
}
BENCHMARK(solid_faces)->Arg(6)->Arg(12)->ArgName("along");

void solid_tetrahedra(benchmark::State& state)
{
    flexpm::SolidState s = cube(static_cast<int>(state.range(0)), slow);
    for (auto _ : state) {
        for (int b = 0; b < s.grains.blocks(); ++b)
            flexpm::add_tetrahedron_forces(s, b);
    }
    count(state, s);
}
BENCHMARK(solid_tetrahedra)->Arg(6)->Arg(12)->ArgName("along");

void solid_step(benchmark::State& state)
{
    flexpm::SolidState s = cube(static_cast<int>(state.range(0)), slow);
    flexpm::StepOptions o;
    o.threads = static_cast<int>(state.range(1));
    for (auto _ : state)
        flexpm::step(s, o);
    count(state, s);
}
BENCHMARK(solid_step)
    ->Args({ 6, 1 })
    ->Args({ 12, 1 })
    ->Args({ 12, 2 })
    ->ArgNames({ "along", "threads" })
    ->UseRealTime();

/// Pressed up to where most contacts have a point past its elastic branch.
void solid_softening(benchmark::State& state)
{
    flexpm::SolidState s = cube(static_cast<int>(state.range(0)), -1e-6);
    for (int k = 0; k < 3000; ++k)
        flexpm::step(s, {});
    for (auto _ : state)
        flexpm::step(s, {});
    count(state, s);
}
BENCHMARK(solid_softening)->Arg(6)->ArgName("along");

}  // namespace
