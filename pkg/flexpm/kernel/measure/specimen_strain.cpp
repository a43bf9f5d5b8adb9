// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/measure/specimen_strain.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/forces/sides.hpp>

namespace flexpm {

namespace {

std::vector<SideShare> shares_of(const Assembly& a, int side)
{
    std::vector<SideShare> shares;
    for (int e = 0; e < a.facets.count; ++e) {
        if (is_on_side(a, e, side))
            shares.push_back({ a.facets.grain[e], facet_place(a, e).length() });
    }
    return shares;
}

StrainGauge gauge_of(const Assembly& a, double height)
{
    double diameters = 0.0;
    for (double r : a.grains.radius)
        diameters += 2.0 * r;
    const double bottom = a.grains.reference_at(side_nodes(a, bottom_side).front()).y;
    return { bottom, height, diameters / a.grains.count, shares_of(a, left_side),
        shares_of(a, right_side), a.grains.erased };
}

}  // namespace

SpecimenStrain specimen_strain(const Assembly& a)
{
    return specimen_strain(a, a.grains.displacement);
}

SpecimenStrain specimen_strain(const Assembly& a, const Array<double>& moved)
{
    const double width = side_length(a, bottom_side), height = side_length(a, left_side);
    check_positive("length of the bottom side", width, "m");
    check_positive("length of the left side", height, "m");
    if (!a.grains.is_rigid(0)) {
        return { (side_displacement(a, top_side, 1, moved)
                     - side_displacement(a, bottom_side, 1, moved))
                / height,
            (side_displacement(a, right_side, 0, moved) - side_displacement(a, left_side, 0, moved))
                / width };
    }
    const auto index = [&](int grain, int axis) {
        return a.grains.component(a.grains.centre(grain), axis);
    };
    return centre_strain(
        gauge_of(a, height), a.grains.count,
        [&](int grain, int axis) { return a.grains.reference[index(grain, axis)]; },
        [&](int grain, int axis) { return moved[index(grain, axis)]; });
}

}  // namespace flexpm
