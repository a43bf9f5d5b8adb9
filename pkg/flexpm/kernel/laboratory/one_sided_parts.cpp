// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/one_sided_parts.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/parts/plate_points.hpp>
#include <flexpm/kernel/statics/one_sided_points.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace flexpm {

namespace {

/// Gap over the largest displacement that a small solution leaves by its turns and its residual
/// [-].
constexpr double small_gap = 1e-6;

/// Marks of the points of each plate that are open.
using OpenPoints = std::vector<PointMarks>;

/// Whether a plate's point can open: it touches at the beginning, without a bond.
bool presses(const Plate& plate, int point)
{
    return !plate.bonded && plate.points[point].opening <= 0.0;
}

/// Whether a plate is free to move and pressed by nothing: it gives way to all that would push it.
bool is_idle(const SolidState& s, int number, const SolidPartLoading& loading)
{
    const auto pushes = [&](const PlatePressure& one) {
        return one.plate == number && one.pressure != 0.0;
    };
    return s.plates[number].loaded && !s.plates[number].bonded
        && std::none_of(loading.pressures.begin(), loading.pressures.end(), pushes);
}

/// The state whose open points keep a share of their stiffness; 0: they have no part in it.
SolidState with_open(SolidState s, const OpenPoints& open, double share)
{
    for (std::size_t i = 0; i < s.plates.size(); ++i) {
        Plate& plate = s.plates[i];
        for (std::size_t k = 0; k < plate.points.size(); ++k) {
            if (!open[i][k]) continue;
            plate.points[k].area *= share;
            if (share == 0.0) plate.points[k].opening = 1.0;
        }
    }
    return s;
}

/// Way of a machine's crosshead where pressures alone act and the plate itself stays: the spring
/// bears what its own plate does.
double crosshead_way(
    const SolidState& s, const PartGeometry& parts, const std::vector<SolidPartShare>& pressed)
{
    if (parts.driven.empty()) return 0.0;
    const int plate = parts.driven.front();
    const double machine = s.plates[plate].machine_stiffness;
    double way = 0.0;
    for (const SolidPartShare& one : pressed)
        if (machine > 0.0)
            way += one.factor * dot(one.small.state.plates[plate].force, parts.direction) / machine;
    return way;
}

/// The linear solution of points that bear so.
SolidPartSolution linear_solution(
    const SolidState& s, const PartGeometry& parts, const SolidPartLoading& asked, double dt)
{
    SolidPartSolution found;
    const auto add = [&](SolidPartState small, double factor) {
        found.load += factor * small.load;
        found.shares.push_back({ std::move(small), factor });
    };
    std::vector<PlatePressure> pressures;
    for (const PlatePressure& one : asked.pressures)
        if (one.pressure != 0.0) pressures.push_back(one);
    if (!pressures.empty()) {
        SolidPartState pressed = pressed_part_state(s, parts, pressures);
        const double whole = 1.0 / pressed.way;
        add(std::move(pressed), whole);
    }
    found.way = crosshead_way(s, parts, found.shares);
    if (!asked.load && asked.way == 0.0 && found.way == 0.0) return found;
    SolidPartState moved = elastic_part_state(s, parts, dt);
    if (asked.load && !(std::fabs(moved.load) > 0.0))
        refuse("load", *asked.load, "N",
            "must not be given: nothing resists it; fix a part that resists it");
    const double factor =
        asked.load ? (*asked.load - found.load) / moved.load : (asked.way - found.way) / moved.way;
    found.way += factor * moved.way;
    add(std::move(moved), factor);
    return found;
}

/// What the gap of a plate's point has grown by in a small solution [m].
double gap_of(const SolidState& s, int number, int point, const SolidState& moved)
{
    const Plate& plate = s.plates[number];
    const Plate& there = moved.plates[number];
    Vector way = -there.displacement;
    const auto& nodes = s.surface.nodes[plate.points[point].facet];
    for (int k = 0; k < 3; ++k)
        way =
            way + corner_share(plate, point, k) * space_vector(moved.grains.displacement, nodes[k]);
    return dot(point_normal(plate, point), way)
        - dot(point_arm(plate, point), there.turn - plate.turn);
}

double largest_displacement(const SolidPartSolution& found)
{
    double sum = 0.0;
    for (const SolidPartShare& one : found.shares) {
        double largest = 0.0;
        for (double v : one.small.state.grains.displacement)
            largest = std::max(largest, std::fabs(v));
        sum += std::fabs(one.factor) * largest;
    }
    return sum;
}

/// Points that are open, as a solution has them.
OpenPoints open_after(
    const SolidState& s, const SolidPartLoading& loading, const SolidPartSolution& found)
{
    OpenPoints open;
    const double none = small_gap * largest_displacement(found);
    for (int i = 0; i < static_cast<int>(s.plates.size()); ++i) {
        const Plate& plate = s.plates[i];
        open.emplace_back(plate.points.size(), 0);
        for (int k = 0; k < plate_points(plate); ++k) {
            if (!presses(plate, k)) continue;
            double gap = 0.0;
            for (const SolidPartShare& one : found.shares)
                gap += one.factor * gap_of(s, i, k, one.small.state);
            open.back()[k] = gap > none || is_idle(s, i, loading);
        }
    }
    return open;
}

bool is_any(const OpenPoints& open)
{
    return std::any_of(open.begin(), open.end(),
        [](const PointMarks& of) { return std::count(of.begin(), of.end(), 1) > 0; });
}

}  // namespace

SolidPartSolution find_elastic_state(
    const SolidState& s, const PartGeometry& parts, const SolidPartLoading& loading, double dt)
{
    check_finite("way of what is driven", loading.way, "m");
    check_finite("load of what is driven", loading.load.value_or(0.0), "N");
    OpenPoints open = open_after(s, loading, {});
    for (int solutions = 1; solutions <= most_plain_solutions; ++solutions) {
        SolidPartSolution found =
            linear_solution(with_open(s, open, open_share), parts, loading, dt);
        OpenPoints next = open_after(s, loading, found);
        if (next == open) {
            if (is_any(open)) found = linear_solution(with_open(s, open, 0.0), parts, loading, dt);
            found.solutions = solutions + (is_any(open) ? 1 : 0);
            return found;
        }
        open = std::move(next);
    }
    fail("find_elastic_state: solutions", number(most_plain_solutions),
        "must suffice until no plate contact opens or closes; bond the plates that fix the "
        "specimen, or place them without friction");
}

}  // namespace flexpm
