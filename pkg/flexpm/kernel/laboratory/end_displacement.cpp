// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/end_displacement.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/forces/sides.hpp>

#include <algorithm>
#include <cmath>

namespace flexpm {

namespace {

constexpr int lateral = 0, axial = 1;

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

}  // namespace flexpm
