// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/gauge.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/parts/soft_plate.hpp>
#include <flexpm/kernel/parts/solid_plates.hpp>
#include <flexpm/kernel/statics/stiffness_matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexpm {

namespace {

Vector reference_of(const Grains& grains, int node)
{
    return grains.vector(grains.reference, node);
}

/// Node nearest to a place, of the grains whose centres are nearer to it than to another place.
int nearest_node(const Grains& grains, Vector place, Vector other)
{
    double least = std::numeric_limits<double>::infinity();
    int nearest = -1;
    for (int g = 0; g < grains.count; ++g) {
        if (grains.erased[g]) continue;
        const Vector centre = reference_of(grains, grains.centre(g));
        if (grains.length(centre - place) > grains.length(centre - other)) continue;
        for (int k = 0; k < grains.nodes_of(g); ++k) {
            const int node = grains.node(g, k);
            const double distance = grains.length(reference_of(grains, node) - place);
            if (!(distance < least)) continue;
            least = distance;
            nearest = node;
        }
    }
    if (nearest < 0)
        refuse("grains near a gauge's point", 0.0, "",
            "must be >= 1 on its side; move the point onto the specimen");
    return nearest;
}

Vector way_of(const Grains& grains, const Array<double>& moved, int node)
{
    const int last = static_cast<int>(moved.size()) - 1;
    if (node < 0 || node > last || grains.component(node, grains.layout.dimension - 1) > last)
        refuse("node of a gauge", node, "", "must be one of gauge_points() or section_at()");
    return grains.vector(moved, node);
}

const Plate& plate_of(const BondedState& s, int plate)
{
    if (plate < 0 || plate >= static_cast<int>(s.plates.size()))
        refuse("plate of a gauge", plate, "", "must be the index of a plate; add one first");
    return s.plates[plate];
}

/// Velocity at which the spring of a soft machine gives way with the motion of the loading [m/s].
double give_rate(const Assembly& a, const Plate& p, const Array<double>& velocity)
{
    return plate_lag(a, p, p.velocity, &velocity).give;
}
double give_rate(const SolidState& s, const Plate& p, const Array<double>& velocity)
{
    return rates_of(s, p, velocity).give;
}

template <class State>
double rate_of_plate(const State& s, int plate, Vector direction, const Array<double>& velocity)
{
    const double rate = crosshead_rate(s, plate, direction);
    const Plate& p = plate_of(s, plate);
    if (p.loaded || p.machine_stiffness == 0.0) return rate;
    return rate - give_rate(s, p, velocity) * dot(p.normal, direction);
}

}  // namespace

GaugePoints gauge_points(const Grains& grains, Vector first, Vector second)
{
    check_positive("length of a gauge", grains.length(second - first), "m");
    return { nearest_node(grains, first, second), nearest_node(grains, second, first) };
}

double gauge_length(const Grains& grains, const GaugePoints& gauge)
{
    return grains.length(reference_of(grains, gauge.second) - reference_of(grains, gauge.first));
}

double gauge_opening(
    const Grains& grains, const Array<double>& moved, const GaugePoints& gauge, Vector direction)
{
    return dot(way_of(grains, moved, gauge.second) - way_of(grains, moved, gauge.first), direction);
}

bool is_erased(const Grains& grains, int node)
{
    way_of(grains, grains.displacement, node);  // it is one
    return grains.erased[grain_node(grains, node).grain] != 0;
}

Section section_at(const Grains& grains, double place, Vector direction, double half_width)
{
    Section found;
    for (int g = 0; g < grains.count; ++g) {
        if (grains.erased[g]) continue;
        for (int k = 0; k < grains.nodes_of(g); ++k) {
            const int node = grains.node(g, k);
            const double along = dot(reference_of(grains, node), direction);
            if (!(std::fabs(along - place) <= half_width)) continue;
            found.nodes.push_back(node);
            found.place += along;
        }
    }
    if (found.nodes.empty()) refuse("nodes in a section", 0.0, "", "must be at least 1");
    found.place /= static_cast<double>(found.nodes.size());
    return found;
}

double mean_way(const Grains& grains, const Array<double>& moved, const std::vector<int>& nodes,
    Vector direction)
{
    if (nodes.empty()) refuse("nodes of a gauge", 0.0, "", "must be at least 1");
    double sum = 0.0;
    for (int node : nodes)
        sum += dot(way_of(grains, moved, node), direction);
    return sum / static_cast<double>(nodes.size());
}

double plate_way(const BondedState& s, int plate, Vector direction)
{
    return dot(plate_of(s, plate).displacement, direction);
}

double crosshead_way(const BondedState& s, int plate, Vector direction)
{
    return dot(crosshead_displacement(plate_of(s, plate)), direction);
}

double crosshead_rate(const BondedState& s, int plate, Vector direction)
{
    const Plate& p = plate_of(s, plate);
    return dot(p.loaded ? s.loading.of_plate(plate).velocity : p.velocity, direction);
}

double machine_energy(const BondedState& s, int plate)
{
    return machine_energy(plate_of(s, plate));
}

double plate_angle(const BondedState& s, int plate)
{
    const Vector turn = plate_of(s, plate).turn;
    return s.grains.layout.dimension == 2 ? turn.z : norm(turn);
}

double plate_rate(const Assembly& a, int plate, Vector direction, const Array<double>& velocity)
{
    return rate_of_plate(a, plate, direction, velocity);
}

double plate_rate(const SolidState& s, int plate, Vector direction, const Array<double>& velocity)
{
    return rate_of_plate(s, plate, direction, velocity);
}

double contact_angle(const SolidState& s, int plate)
{
    const Plate& read = plate_of(s, plate);
    if (read.jaw_radius == 0.0) return 0.0;
    double low = read.position.y, high = low;
    for (const PlatePoint& point : read.points) {
        for (int n : s.surface.nodes[point.facet]) {
            const double y = reference_of(s.grains, n).y;
            low = std::min(low, y);
            high = std::max(high, y);
        }
    }
    return pressed_area(read) / (read.disc_radius * (high - low));
}

}  // namespace flexpm
