// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/test_frame.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/laboratory/end_displacement.hpp>
#include <flexpm/kernel/measure/specimen_strain.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>

#include <algorithm>

namespace flexpm {

namespace {

constexpr int y_axis = 1;

/// Force on the specimen at its top or bottom: of the plates there, else of what holds the nodes.
double end_force(const Assembly& a, int side)
{
    return has_plates(a, side) ? plate_force(a, side).y : reaction(a, side_nodes(a, side), y_axis);
}

/// Mean lateral pressure on the right and left sides.
double lateral_pressure(const Assembly& a, double height)
{
    if (has_plates(a, right_side)) {
        const double squeeze = plate_force(a, left_side).x - plate_force(a, right_side).x;
        return 0.5 * squeeze / a.area_of(height);
    }
    for (int e = 0; e < a.facets.count; ++e) {
        if (is_on_side(a, e, right_side)) return a.facets.pressure[e];
    }
    return 0.0;
}

/// Growth of the distance between the outermost left and right grains of a disc [m].
double disc_widening(const Assembly& a)
{
    const auto& erased = a.grains.erased;
    const auto there = std::find(erased.begin(), erased.end(), 0) - erased.begin();
    if (there == a.grains.count) return 0.0;
    int first = a.grains.centre(static_cast<int>(there)), last = first;
    for (int g = 0; g < a.grains.count; ++g) {
        if (erased[g]) continue;
        const int c = a.grains.centre(g);
        if (a.grains.reference[c] < a.grains.reference[first]) first = c;
        if (a.grains.reference[c] > a.grains.reference[last]) last = c;
    }
    return a.grains.displacement[last] - a.grains.displacement[first];
}

}  // namespace

TestFrame rectangle_frame(const Assembly& a, Sense sense)
{
    need_sides(a);
    const double sign = sense == Sense::compression ? -1.0 : 1.0;
    TestFrame frame;
    frame.area = a.area_of(side_length(a, bottom_side));
    frame.height = side_length(a, left_side);
    frame.sense = sense;
    frame.ends = [](const Assembly& now) {
        return EndForces { end_force(now, bottom_side), end_force(now, top_side) };
    };
    frame.strains = [sign](const Assembly& now) {
        const SpecimenStrain strain = specimen_strain(now);
        return TestStrains { sign * strain.axial, -sign * strain.lateral };
    };
    frame.confinement = [height = frame.height](
                            const Assembly& now) { return lateral_pressure(now, height); };
    return frame;
}

TestFrame disc_frame(const Assembly& a, double diameter)
{
    check_positive("diameter", diameter, "m");
    if (a.plates.size() < 2) {
        refuse("disc_frame: plates", static_cast<double>(a.plates.size()), "",
            "must be a lower and an upper one; add them first");
    }
    TestFrame frame;
    frame.area = splitting_area(diameter, a.thickness);
    frame.height = diameter;
    frame.ends = [](const Assembly& now) {
        return EndForces { now.plates[0].force.y, now.plates[1].force.y };
    };
    frame.strains = [diameter](const Assembly& now) {
        const double closure = now.plates[0].displacement.y - now.plates[1].displacement.y;
        return TestStrains { closure / diameter, disc_widening(now) / diameter };
    };
    return frame;
}

TestScales rectangle_scales(const Assembly& a, Sense sense, double dt)
{
    need_sides(a);
    return rectangle_scales(
        scale_inputs(a, sense, dt), side_length(a, bottom_side), side_length(a, left_side));
}

TestScales disc_scales(const Assembly& a, double diameter, double dt)
{
    check_positive("diameter", diameter, "m");
    return disc_scales(scale_inputs(a, Sense::tension, dt), diameter);
}

double splitting_area(double diameter, double thickness) { return 0.5 * pi * diameter * thickness; }

double lateral_strain(const Assembly& a, Sense sense, const Array<double>& moved)
{
    const double lateral = specimen_strain(a, moved).lateral;
    return sense == Sense::compression ? lateral : -lateral;
}

}  // namespace flexpm
