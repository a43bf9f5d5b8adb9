// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Axial loading of a rectangle.
#include <flexpm/kernel/laboratory/axial_measures.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/forces/plate_contact.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/motion/rigid_grain.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace flexpm {

namespace {

constexpr int lateral = 0, axial = 1;
constexpr double pi = 3.14159265358979323846;

void need_sides(const Assembly& a)
{
    for (int side : { bottom_side, right_side, top_side, left_side }) {
        if (std::count(a.edge_side.begin(), a.edge_side.end(), side) > 0) continue;
        throw std::invalid_argument("specimen side " + std::to_string(side)
            + " has no edges, an axial test needs a rectangle of four sides; use another outline");
    }
}

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
        return 0.5 * squeeze / (g.height * a.thickness);
    }
    for (int e = 0; e < a.edges; ++e) {
        if (a.edge_side[e] == right_side) return a.edge_pressure[e];
    }
    return 0.0;
}

/// What every test records.
void add_common(const Assembly& a, AxialObservation& o)
{
    o.unbalanced_ratio = unbalanced_ratio(a);
    o.cracks = count_cracks(a);
    o.energies = energies(a);
}

/// Growth of the distance between the outermost left and right grains of a disc [m].
double disc_widening(const Assembly& a)
{
    int first = a.centre(0), last = first;
    for (int g = 0; g < a.grains; ++g) {
        const int c = a.centre(g);
        if (a.reference[c] < a.reference[first]) first = c;
        if (a.reference[c] > a.reference[last]) last = c;
    }
    return a.displacement[last] - a.displacement[first];
}

double crossing(const Assembly& a, double height, double width, double dt)
{
    double mass = 0.0;
    for (double m : a.inverse_mass)
        mass += m > 0.0 ? 1.0 / m : 0.0;
    return std::sqrt(mass * height / (series_modulus(a) * width * a.thickness)) / dt;
}

}  // namespace

TestState judge(const AxialObservation& now, double peak, const AxialEnd& end)
{
    if (peak >= end.least_peak && now.axial_stress < end.stop_ratio * peak) {
        return TestState::past_peak;
    }
    return now.axial_strain >= end.largest_strain ? TestState::largest_strain_reached
                                                  : TestState::running;
}

AxialGeometry rectangle_of(const Assembly& a, Sense sense)
{
    need_sides(a);
    return { side_length(a, bottom_side), side_length(a, left_side), sense };
}

AxialObservation observe(const Assembly& a, const AxialGeometry& g)
{
    const double sign = g.sense == Sense::compression ? -1.0 : 1.0;
    const double top = end_force(a, top_side);
    const double bottom = end_force(a, bottom_side);
    AxialObservation o;
    o.step = a.step;
    const SpecimenStrain strain = specimen_strain(a);
    o.axial_strain = sign * strain.axial;
    o.lateral_strain = -sign * strain.lateral;
    // Deviation D25: the drag of damping on the moving grains adds to one end what it takes from the
    // other
    o.axial_stress = sign * 0.5 * (top - bottom) / (g.width * a.thickness);
    o.confinement = lateral_pressure(a, g);
    const double larger = std::max(std::fabs(top), std::fabs(bottom));
    o.end_mismatch = larger > 0.0 ? std::fabs(top + bottom) / larger : 0.0;
    add_common(a, o);
    return o;
}

AxialObservation observe_disc(const Assembly& a, double diameter)
{
    if (a.plates.size() < 2) {
        throw std::invalid_argument("observe_disc: plates = " + std::to_string(a.plates.size())
            + ", must be a lower and an upper one; add them first");
    }
    const Plate &lower = a.plates[0], &upper = a.plates[1];
    const double up = lower.force.y, down = -upper.force.y;
    AxialObservation o;
    o.step = a.step;
    o.axial_strain = (lower.displacement.y - upper.displacement.y) / diameter;
    o.lateral_strain = disc_widening(a) / diameter;
    o.axial_stress = (up + down) / (pi * diameter * a.thickness);
    const double larger = std::max(std::fabs(up), std::fabs(down));
    o.end_mismatch = larger > 0.0 ? std::fabs(up - down) / larger : 0.0;
    add_common(a, o);
    return o;
}

void grip_bottom(Assembly& a)
{
    need_sides(a);
    const std::vector<int> bottom = side_nodes(a, bottom_side);
    drive(a, bottom, axial, 0.0);
    // the node nearest to the middle: the specimen then bulges evenly
    double middle = 0.0;
    for (int n : bottom)
        middle += a.reference[n] / static_cast<double>(bottom.size());
    const int nearest = *std::min_element(bottom.begin(), bottom.end(), [&](int m, int n) {
        return std::fabs(a.reference[m] - middle) < std::fabs(a.reference[n] - middle);
    });
    drive(a, { nearest }, lateral, 0.0);
}

void move_top(Assembly& a, double velocity) { drive(a, side_nodes(a, top_side), axial, velocity); }

double series_modulus(const Assembly& a)
{
    double diameter = 0.0;
    for (double r : a.radius)
        diameter += 2.0 * r / a.grains;
    const double of_contacts =
        grain_mean(a, [&](int g) { return own_law(a, g).normal_stiffness; }) * diameter;
    if (a.is_rigid(0)) return of_contacts;
    const double young = grain_mean(a, [&](int g) { return a.elastic[a.grain_material[g]].young; });
    return 1.0 / (1.0 / young + 1.0 / of_contacts);
}

double crossing_steps(const Assembly& a, double dt)
{
    const AxialGeometry g = rectangle_of(a, Sense::compression);
    return crossing(a, g.height, g.width, dt);
}

TestScales rectangle_scales(const Assembly& a, Sense sense, double dt)
{
    const AxialGeometry g = rectangle_of(a, sense);
    return { crossing_steps(a, dt), series_modulus(a), reference_strength(a, sense), g.height,
        g.width };
}

TestScales disc_scales(const Assembly& a, double diameter, double dt)
{
    return { crossing(a, diameter, 0.25 * pi * diameter, dt), 0.25 * series_modulus(a),
        reference_strength(a, Sense::tension), diameter, diameter };
}

double ramp_factor(std::int64_t step, int ramp_steps)
{
    return step + 1 < ramp_steps ? static_cast<double>(step + 1) / ramp_steps : 1.0;
}

double reference_strength(const Assembly& a, Sense sense)
{
    if (sense == Sense::tension) {
        return grain_mean(a, [&](int g) { return own_law(a, g).tensile_strength; });
    }
    const double cohesion = grain_mean(a, [&](int g) { return own_law(a, g).cohesion; });
    const double friction = grain_mean(a, [&](int g) { return own_law(a, g).friction; });
    // cos(phi) / (1 - sin(phi)) with tan(phi) = mu
    return 2.0 * cohesion * (std::sqrt(1.0 + friction * friction) + friction);
}

}  // namespace flexpm
