// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/end_displacement.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/parts/node_sets.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/topology/plate_build.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexpm {

namespace {

constexpr int lateral = 0, axial = 1;

bool is_driven(const EndLoading& asked) { return asked.way != 0.0 || asked.load; }

/// Whether the upper nodes are held: the test drives them.
bool is_top_held(const Assembly& a)
{
    const int last = side_nodes(a, top_side).back();
    return a.grains.prescribed[a.grains.component(last, axial)] != 0;
}

/// Hold the ends by their nodes; the upper ones are a set that can be driven.
void hold_nodes(Assembly& a, const EndLoading& asked, ElasticLoading& loading)
{
    const bool held = is_top_held(a);
    grip_bottom(a);
    const std::vector<int> top = side_nodes(a, top_side);
    for (int side : { right_side, left_side })
        if (asked.pressure) set_pressure(a, side, *asked.pressure);
    if (!held && !is_driven(asked)) {
        if (asked.pressure) set_pressure(a, top_side, *asked.pressure);
        return;
    }
    set_pressure(a, top_side, 0.0);
    for (int node : top)
        a.grains.prescribed[a.grains.component(node, axial)] = 0;
    loading.sets.push_back(add_node_set(a, top, { false, true, false }));
}

/// Keep the grain in the middle of the lower end where it is along it, as smooth plates do not.
void hold_middle(Assembly& a)
{
    const std::vector<int> bottom = side_nodes(a, bottom_side);
    double middle = 0.0;
    for (int n : bottom)
        middle += a.grains.reference[n] / static_cast<double>(bottom.size());
    int nearest = a.grains.centre(0);
    double least = std::numeric_limits<double>::infinity();
    for (int e = 0; e < a.facets.count; ++e) {
        const int c = a.grains.centre(a.facets.grain[e]);
        const double off = std::fabs(a.grains.reference[c] - middle);
        if (!is_on_side(a, e, bottom_side) || !(off < least)) continue;
        nearest = c;
        least = off;
    }
    a.grains.prescribed[a.grains.component(nearest, lateral)] = 1;
}

/// Lay a disc between two plates, or take those that are there.
void hold_disc(Assembly& a, const EndLoading& asked, ElasticLoading& loading)
{
    if (asked.pressure)
        refuse("pressure on a disc", *asked.pressure, "Pa", "must be left out; it has no sides");
    for (const Point normal : { Point { 0.0, 1.0 }, Point { 0.0, -1.0 } })
        if (a.plates.size() < 2) fix_tangential(a, add_touching_plate(a, normal, {}));
    loading.plates.push_back(1);
}

/// Lay a rectangle between plates, and its membrane, or take those that are there.
void hold_plates(Assembly& a, const EndLoading& asked, ElasticLoading& loading)
{
    const PlateContact contact { 0.0, 0.0, asked.tension };
    const bool new_ends = !has_plates(a, top_side);
    for (int side : { bottom_side, top_side })
        if (new_ends) add_side_plates(a, side, 1, contact);
    for (int side : { left_side, right_side }) {
        if (asked.pressure.value_or(0.0) > 0.0 && !has_plates(a, side))
            add_side_plates(a, side, asked.pieces, {});
    }
    hold_middle(a);
    for (std::size_t i = 0; i < a.plates.size(); ++i) {
        const Plate& plate = a.plates[i];
        const bool top = plate.side == top_side;
        if (top && (is_driven(asked) || !(new_ends || plate.loaded)))
            loading.plates.push_back(static_cast<int>(i));
        else if (asked.pressure && plate.side != bottom_side)
            loading.pressures.emplace_back(static_cast<int>(i), *asked.pressure);
    }
}

/// Whether a loading has taken the top over from the pressure.
bool is_top_driven(const Assembly& a, const EndLoading& asked)
{
    if (!asked.plates) return is_top_held(a);
    return std::any_of(a.plates.begin(), a.plates.end(),
        [](const Plate& p) { return p.side == top_side && !p.loaded; });
}

}  // namespace

void need_sides(const Assembly& a)
{
    for (int side : { bottom_side, right_side, top_side, left_side }) {
        if (has_facets(a, side)) continue;
        refuse("edges of side " + std::to_string(side), 0.0, "",
            "an axial test needs a rectangle of four sides; use another outline");
    }
}

void grip_bottom(Assembly& a)
{
    need_sides(a);
    const std::vector<int> bottom = side_nodes(a, bottom_side);
    prescribe(a, bottom, axial, 0.0);
    // the node nearest to the middle: the specimen then bulges evenly
    double middle = 0.0;
    for (int n : bottom)
        middle += a.grains.reference[n] / static_cast<double>(bottom.size());
    const int nearest = *std::min_element(bottom.begin(), bottom.end(), [&](int m, int n) {
        return std::fabs(a.grains.reference[m] - middle)
            < std::fabs(a.grains.reference[n] - middle);
    });
    prescribe(a, { nearest }, lateral, 0.0);
}

void move_top(Assembly& a, double velocity)
{
    prescribe(a, side_nodes(a, top_side), axial, velocity);
}

double ramp_factor(std::int64_t step, int ramp_steps)
{
    if (step + 1 >= ramp_steps) return 1.0;
    const double part = static_cast<double>(step + 1) / ramp_steps;
    // what begins and ends with no rate and no change of it raises the least of a wave
    return part * part * part * (10.0 - 15.0 * part + 6.0 * part * part);
}

double ramped(double start, double full, std::int64_t done, int ramp_steps)
{
    return start + (full - start) * ramp_factor(done, ramp_steps);
}

ElasticState find_end_state(const Assembly& a, const EndLoading& asked)
{
    const auto& erased = a.grains.erased;
    if (std::find(erased.begin(), erased.end(), 0) == erased.end())
        refuse("grains that are left", 0.0, "", "must be at least 1; build the specimen again");
    if (!asked.disc) need_sides(a);  // which may have lost their grains
    if (asked.pressure && is_driven(asked) && !is_top_driven(a, asked)) {
        // as a test does: the top takes its shape under the pressure, and goes on as it is then
        EndLoading first = asked, then = asked;
        first.way = 0.0;
        first.load.reset();
        then.pressure.reset();
        const ElasticState pressed = find_end_state(a, first);
        ElasticState found = find_end_state(pressed.state, then);
        found.solutions += pressed.solutions;
        return found;
    }
    Assembly held = a;
    ElasticLoading loading;
    loading.direction = { 0.0, asked.tension ? 1.0 : -1.0 };
    loading.way = asked.way;
    loading.load = asked.load;
    if (asked.disc)
        hold_disc(held, asked, loading);
    else if (asked.plates)
        hold_plates(held, asked, loading);
    else
        hold_nodes(held, asked, loading);
    return find_elastic_state(held, loading);
}

}  // namespace flexpm
