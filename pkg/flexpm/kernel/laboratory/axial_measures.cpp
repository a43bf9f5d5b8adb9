// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/axial_measures.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/forces/plate_contact.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/laboratory/end_displacement.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace flexpm {

namespace {

constexpr int axial = 1;

/// Force on the specimen at its top or bottom: of the plates there, else of what holds the nodes.
double end_force(const Assembly& a, int side)
{
    return has_plates(a, side) ? plate_force(a, side).y : reaction(a, side_nodes(a, side), axial);
}

/// Mean lateral pressure on the right and left sides.
double lateral_pressure(const Assembly& a, const AxialGeometry& g)
{
    if (has_plates(a, right_side)) {
        const double squeeze = plate_force(a, left_side).x - plate_force(a, right_side).x;
        return 0.5 * squeeze / a.area_of(g.height);
    }
    for (int e = 0; e < a.edges.count; ++e) {
        if (is_on_side(a, e, right_side)) return a.edges.pressure[e];
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

double axial_stress(const EndForces& ends, Sense sense, double area)
{
    const double sign = sense == Sense::compression ? -1.0 : 1.0;
    // Deviation D25: the drag of damping on the moving grains adds to one end what it takes from the
    // other
    return sign * 0.5 * (ends.top - ends.bottom) / area;
}

double end_mismatch(const EndForces& ends)
{
    const double larger = std::max(std::fabs(ends.top), std::fabs(ends.bottom));
    return larger > 0.0 ? std::fabs(ends.top + ends.bottom) / larger : 0.0;
}

AxialObservation observe_ends(const Assembly& a, const EndForces& ends, Sense sense, double area)
{
    AxialObservation o;
    o.step = a.step;
    o.axial_stress = axial_stress(ends, sense, area);
    o.end_mismatch = end_mismatch(ends);
    o.unbalanced_ratio = unbalanced_ratio(a);
    o.cracks = count_cracks(a);
    o.energies = energies(a);
    return o;
}

double splitting_area(double diameter, double thickness) { return 0.5 * pi * diameter * thickness; }

const char* find_bad_value(const AxialObservation& now)
{
    const Energies& e = now.energies;
    const std::pair<const char*, double> values[] = { { "axial stress", now.axial_stress },
        { "axial strain", now.axial_strain }, { "confinement", now.confinement },
        { "unbalanced ratio", now.unbalanced_ratio }, { "kinetic energy", e.kinetic },
        { "elastic energy", e.elastic }, { "damage energy", e.damage },
        { "friction energy", e.friction }, { "damping energy", e.damping },
        { "potential energy", e.potential }, { "boundary work", e.boundary_work } };
    for (const auto& [name, value] : values)
        if (!std::isfinite(value)) return name;
    return nullptr;
}

double differential_stress(const AxialObservation& now)
{
    return now.axial_stress - now.confinement;
}

AxialGeometry rectangle_of(const Assembly& a, Sense sense)
{
    need_sides(a);
    return { side_length(a, bottom_side), side_length(a, left_side), sense };
}

double lateral_strain(const Assembly& a, Sense sense, const Array<double>& moved)
{
    const double lateral = specimen_strain(a, moved).lateral;
    return sense == Sense::compression ? lateral : -lateral;
}

AxialObservation observe(const Assembly& a, const AxialGeometry& g)
{
    const double sign = g.sense == Sense::compression ? -1.0 : 1.0;
    const EndForces ends = { end_force(a, bottom_side), end_force(a, top_side) };
    AxialObservation o = observe_ends(a, ends, g.sense, a.area_of(g.width));
    const SpecimenStrain strain = specimen_strain(a);
    o.axial_strain = sign * strain.axial;
    o.lateral_strain = -sign * strain.lateral;
    o.confinement = lateral_pressure(a, g);
    return o;
}

AxialObservation observe_disc(const Assembly& a, double diameter)
{
    check_positive("diameter", diameter, "m");
    if (a.plates.size() < 2) {
        refuse("observe_disc: plates", static_cast<double>(a.plates.size()), "",
            "must be a lower and an upper one; add them first");
    }
    const Plate &lower = a.plates[0], &upper = a.plates[1];
    AxialObservation o = observe_ends(a, { lower.force.y, upper.force.y }, Sense::compression,
        splitting_area(diameter, a.thickness));
    o.axial_strain = (lower.displacement.y - upper.displacement.y) / diameter;
    o.lateral_strain = disc_widening(a) / diameter;
    return o;
}

}  // namespace flexpm
