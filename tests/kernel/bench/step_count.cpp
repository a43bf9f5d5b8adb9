// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  A fixed number of steps of fixed specimens; scripts/checks/instructions.py counts what
/// they cost.
#include "loaded.hpp"
#include "solid_loaded.hpp"

#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/pairs/pair_search.hpp>

#include <algorithm>
#include <cstdio>
#include <exception>

namespace {

constexpr int rows = 24;
constexpr double size = 3e-3;          // [m]
constexpr double slow = -1e-9 * rows;  // no point leaves its elastic branch
constexpr double fast = 2e-7 * rows;   // every point in tension softens after a few steps

constexpr int along = 5;         // grains of a cube
constexpr double torn = 5e-4;    // strain at which all points of bodies are past their strength
constexpr double parted = 0.05;  // strain at which contacts end
constexpr double steady = 1e-9;  // strain of a step

/// Steps of a cube: `solid` or `solid-rigid`, with `-torn` one whose points open and slide, with
/// `-parted` one whose grains press as pairs.
bool step_solid(const std::string& name)
{
    const bool rigid = name.find("rigid") != std::string::npos;
    const bool pairs = name.find("parted") != std::string::npos;
    const bool broken = pairs || name.find("torn") != std::string::npos;
    flexpm::SolidState s = loaded::cube(along, rigid);
    loaded::strain(s, -steady, pairs ? parted : broken ? torn : 0.0);
    if (pairs) flexpm::look_for_pairs(s);
    flexpm::StepOptions o;
    o.leave_nodes = true;
    for (int i = 0; i < 40; ++i)
        flexpm::step(s, o);
    flexpm::show_nodes(s);
    const flexpm::Energies e = flexpm::energies(s);
    const auto pressing = std::count_if(s.pairs.begin(), s.pairs.end(),
        [](const flexpm::PairContact& pair) { return pair.presses(); });
    std::printf("%d grains, %d contacts, %zu pairs, %td press, elastic %.3g J, damage %.3g J, "
                "friction %.3g J\n",
        s.grains.count, s.contacts.count, s.pairs.size(), pressing, e.elastic, e.damage,
        e.friction);
    return (e.damage > 0.0 && e.friction > 0.0) == broken && (pressing > 0) == pairs;
}

}  // namespace

int main(int argc, char** argv)
{
    const std::string name = argc == 2 ? argv[1] : "";
    const bool softening = name == "softening", joints = name == "joints";
    try {
        if (name.rfind("solid", 0) == 0) return step_solid(name) ? 0 : 1;
        const specimens::Specimen grid = specimens::grid(rows, rows, size);
        flexpm::AssemblyOptions options = loaded::options(softening || joints ? "refined" : name);
        if (joints) {
            options.joints = { specimens::strong_contact() };
            // one joint, from side to side
            for (const flexpm::SharedEdge& e : grid.cells.shared_edges) {
                const bool upwards = e.cell_b == e.cell_a + rows;
                options.edge_joint.push_back(upwards && e.cell_a / rows == rows / 2 ? 0 : -1);
            }
        }
        flexpm::Assembly a = specimens::assemble(grid, options);
        loaded::load(a, softening ? fast : slow);
        loaded::run(a, 40);
        const flexpm::Energies e = flexpm::energies(a);
        std::printf("%d grains, %d contacts, elastic %.3g J, damage %.3g J\n", a.grains.count,
            a.contacts.count, e.elastic, e.damage);
        return (e.damage > 0.0) == softening ? 0 : 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr,
            "step_count: %s (or: softening, joints, solid[-rigid][-torn|-parted])\n", error.what());
        return 2;
    }
}
