// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/axial_measures.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace flexpm {

double axial_stress(const EndForces& ends, Sense sense, double area)
{
    const double sign = sense == Sense::compression ? -1.0 : 1.0;
    // Deviation D25: the drag of damping on the moving grains adds to one end what it takes from
    // the other
    return sign * 0.5 * (ends.top - ends.bottom) / area;
}

double end_mismatch(const EndForces& ends)
{
    const double larger = std::max(std::fabs(ends.top), std::fabs(ends.bottom));
    return larger > 0.0 ? std::fabs(ends.top + ends.bottom) / larger : 0.0;
}

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

}  // namespace flexpm
