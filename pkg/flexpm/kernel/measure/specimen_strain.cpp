// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Mean strains of a rectangular specimen.
#include <flexpm/kernel/measure/specimen_strain.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/checks.hpp>
#include <flexpm/kernel/forces/sides.hpp>

#include <cmath>

namespace flexpm {

namespace {

/// Mean place and displacement of grain centres along one axis.
struct Station {
    double weight = 0.0, place = 0.0, displacement = 0.0;

    void add(const Assembly& a, int grain, int component, double share)
    {
        const int i = a.centre(grain) + component * lanes;
        weight += share;
        place += share * a.reference[i];
        displacement += share * a.displacement[i];
    }
};

double strain_between(const Station& first, const Station& second)
{
    const double u = second.displacement / second.weight - first.displacement / first.weight;
    return u / (second.place / second.weight - first.place / first.weight);
}

void need_grains(const Station& s, double height)
{
    if (s.weight != 0.0) return;
    refuse("height of a strain gauge", height, "m", "has no grain near; use smaller grains");
}

/// Between the grains whose centres are within a mean diameter of a height `low` above the bottom and
/// those of a height `high`.
double band_strain(const Assembly& a, double low, double high)
{
    double diameters = 0.0;
    for (double r : a.radius)
        diameters += 2.0 * r;
    // a little more, so that round-off does not choose
    const double reach = 1.001 * diameters / a.grains;
    const double bottom = a.reference[side_nodes(a, bottom_side).front() + lanes];
    Station at_low, at_high;
    for (int g = 0; g < a.grains; ++g) {
        const double y = a.reference[a.centre(g) + lanes] - bottom;
        if (std::fabs(y - low) <= reach) at_low.add(a, g, 1, 1.0);
        if (std::fabs(y - high) <= reach) at_high.add(a, g, 1, 1.0);
    }
    need_grains(at_low, low);
    need_grains(at_high, high);
    return strain_between(at_low, at_high);
}

Station side_grains(const Assembly& a, int side)
{
    Station s;
    for (int e = 0; e < a.edges; ++e) {
        if (a.edge_side[e] != side) continue;
        const auto n = edge_nodes(a, e);
        s.add(a, a.edge_grain[e], 0,
            std::hypot(a.reference[n[1]] - a.reference[n[0]],
                a.reference[n[1] + lanes] - a.reference[n[0] + lanes]));
    }
    return s;
}

}  // namespace

SpecimenStrain specimen_strain(const Assembly& a)
{
    const double width = side_length(a, bottom_side), height = side_length(a, left_side);
    check_positive("length of the bottom side", width, "m");
    check_positive("length of the left side", height, "m");
    if (a.is_rigid(0)) {
        return { band_strain(a, 0.25 * height, 0.75 * height),
            strain_between(side_grains(a, left_side), side_grains(a, right_side)) };
    }
    return { (side_displacement(a, top_side, 1) - side_displacement(a, bottom_side, 1)) / height,
        (side_displacement(a, right_side, 0) - side_displacement(a, left_side, 0)) / width };
}

}  // namespace flexpm
