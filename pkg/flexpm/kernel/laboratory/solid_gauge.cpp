// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/solid_gauge.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/parts/solid_plates.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexpm {

SolidSection section_at(const SolidState& s, double place, Vector direction, double half_width)
{
    SolidSection found;
    for (int g = 0; g < s.grains.count; ++g) {
        for (int k = 0; k < s.grains.nodes_of(g); ++k) {
            const int node = s.grains.node(g, k);
            const double along = dot(space_vector(s.grains.reference, node), direction);
            if (!(std::fabs(along - place) <= half_width)) continue;
            found.nodes.push_back(node);
            found.place += along;
        }
    }
    if (found.nodes.empty()) refuse("nodes in a section", 0.0, "", "must be at least 1");
    found.place /= static_cast<double>(found.nodes.size());
    return found;
}

namespace {

/// Node nearest to a place, of the grains whose centres are nearer to it than to another one.
int nearest_node(const SolidState& s, Vector place, Vector other)
{
    int found = -1;
    double nearest = std::numeric_limits<double>::infinity();
    for (int g = 0; g < s.grains.count; ++g) {
        const Vector centre = space_vector(s.grains.reference, s.grains.centre(g));
        if (norm(centre - place) > norm(centre - other)) continue;
        for (int k = 0; k < s.grains.nodes_of(g); ++k) {
            const int node = s.grains.node(g, k);
            const double distance = norm(space_vector(s.grains.reference, node) - place);
            if (!(distance < nearest)) continue;
            nearest = distance;
            found = node;
        }
    }
    if (found < 0) refuse("grains near a point of a gauge", 0.0, "", "must be at least 1");
    return found;
}

Vector way_of(const Array<double>& moved, int node)
{
    const int last = static_cast<int>(moved.size()) - space_layout.node_stride;
    if (node < 0 || node > last)
        refuse("node of a gauge", node, "", "must be one of gauge_points() or section_at()");
    return space_vector(moved, node);
}

const Plate& plate_at(const SolidState& s, int plate)
{
    if (plate < 0 || plate >= static_cast<int>(s.plates.size()))
        refuse("plate of a gauge", plate, "", "must be the number of a plate; lay one first");
    return s.plates[plate];
}

}  // namespace

GaugePoints gauge_points(const SolidState& s, Vector first, Vector second)
{
    check_positive("length of a gauge", norm(second - first), "m");
    return { nearest_node(s, first, second), nearest_node(s, second, first) };
}

double gauge_length(const SolidState& s, const GaugePoints& gauge)
{
    return norm(space_vector(s.grains.reference, gauge.second)
        - space_vector(s.grains.reference, gauge.first));
}

double opening_in_space(const Array<double>& moved, const GaugePoints& gauge, Vector direction)
{
    return dot(way_of(moved, gauge.second) - way_of(moved, gauge.first), direction);
}

double plate_way(const SolidState& s, int plate, Vector direction)
{
    return dot(plate_at(s, plate).displacement, direction);
}

double crosshead_way(const SolidState& s, int plate, Vector direction)
{
    return dot(crosshead_displacement(plate_at(s, plate)), direction);
}

double crosshead_rate(const SolidState& s, int plate, Vector direction)
{
    const Plate& read = plate_at(s, plate);
    return dot(read.loaded ? s.loading.of_plate(plate).velocity : read.velocity, direction);
}

double plate_rate(const SolidState& s, int plate, Vector direction, const Array<double>& velocity)
{
    const Plate& read = plate_at(s, plate);
    return crosshead_rate(s, plate, direction)
        - rates_of(s, read, velocity).give * dot(read.normal, direction);
}

double machine_energy(const SolidState& s, int plate) { return machine_energy(plate_at(s, plate)); }

double tilt(const SolidState& s, int plate) { return norm(plate_at(s, plate).turn); }

double contact_angle(const SolidState& s, int plate)
{
    const Plate& read = plate_at(s, plate);
    if (read.jaw_radius == 0.0) return 0.0;
    double low = read.position.y, high = low;
    for (int t : read.facets) {
        for (int n : s.surface.nodes[t]) {
            const double y = space_vector(s.grains.reference, n).y;
            low = std::min(low, y);
            high = std::max(high, y);
        }
    }
    return pressed_area(read) / (read.disc_radius * (high - low));
}

double mean_way_in_space(
    const Array<double>& moved, const std::vector<int>& nodes, Vector direction)
{
    if (nodes.empty()) refuse("nodes of a gauge", 0.0, "", "must be at least 1");
    double sum = 0.0;
    for (int node : nodes)
        sum += dot(way_of(moved, node), direction);
    return sum / static_cast<double>(nodes.size());
}

}  // namespace flexpm
