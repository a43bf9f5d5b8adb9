// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/gauge.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/statics/stiffness_matrix.hpp>

#include <cmath>
#include <limits>

namespace flexpm {

namespace {

Point reference_of(const Assembly& a, int node) { return a.grains.reference_at(node); }

/// Node nearest to a place, of the grains whose centres are nearer to it than to another place.
int nearest_node(const Assembly& a, Point place, Point other)
{
    double least = std::numeric_limits<double>::infinity();
    int nearest = -1;
    for (int g = 0; g < a.grains.count; ++g) {
        if (a.grains.erased[g]) continue;
        const Point centre = reference_of(a, a.grains.centre(g));
        if (norm(centre - place) > norm(centre - other)) continue;
        for (int k = 0; k < a.grains.nodes_of(g); ++k) {
            const int node = a.grains.node(g, k);
            const double distance = norm(reference_of(a, node) - place);
            if (!(distance < least)) continue;
            least = distance;
            nearest = node;
        }
    }
    if (nearest < 0)
        refuse("grains near a gauge's point", 0.0, "", "must be at least 1 on its side");
    return nearest;
}

void need_node(const Array<double>& moved, int node)
{
    const int last = static_cast<int>(moved.size()) - lanes;
    if (node < 0 || node >= last)
        refuse("node of a gauge", node, "", "must be one of gauge_points() or section_at()");
}

}  // namespace

GaugePoints gauge_points(const Assembly& a, Point first, Point second)
{
    check_positive("length of a gauge", norm(second - first), "m");
    return { nearest_node(a, first, second), nearest_node(a, second, first) };
}

double gauge_length(const Assembly& a, const GaugePoints& gauge)
{
    return norm(reference_of(a, gauge.second) - reference_of(a, gauge.first));
}

namespace {

const Plate& plate_of(const Assembly& a, int plate)
{
    if (plate < 0 || plate >= static_cast<int>(a.plates.size()))
        refuse("plate of a gauge", plate, "", "must be the number of a plate; add one first");
    return a.plates[plate];
}

}  // namespace

double plate_way(const Assembly& a, int plate, Vector direction)
{
    return dot(plate_of(a, plate).displacement, direction);
}

double crosshead_way(const Assembly& a, int plate, Vector direction)
{
    return dot(crosshead_displacement(plate_of(a, plate)), direction);
}

double crosshead_rate(const Assembly& a, int plate, Vector direction)
{
    const Plate& p = plate_of(a, plate);
    return dot(p.loaded ? a.loading.of_plate(plate).velocity : p.velocity, direction);
}

double plate_rate(const Assembly& a, int plate, Vector direction, const Array<double>& velocity)
{
    const double rate = crosshead_rate(a, plate, direction);
    const Plate& p = plate_of(a, plate);
    if (p.loaded || p.machine_stiffness == 0.0) return rate;
    return rate - plate_lag(a, p, p.velocity, &velocity).give * dot(p.normal, direction);
}

double gauge_opening(const Array<double>& moved, const GaugePoints& gauge, Vector direction)
{
    for (int node : { gauge.first, gauge.second })
        need_node(moved, node);
    return dot(vector_at(moved, gauge.second) - vector_at(moved, gauge.first), direction);
}

bool is_erased(const Assembly& a, int node)
{
    need_node(a.grains.displacement, node);
    return a.grains.erased[grain_node(a.grains, node).grain] != 0;
}

Section section_at(const Assembly& a, double place, Vector direction, double half_width)
{
    Section found;
    for (int g = 0; g < a.grains.count; ++g) {
        if (a.grains.erased[g]) continue;
        for (int k = 0; k < a.grains.nodes_of(g); ++k) {
            const int node = a.grains.node(g, k);
            const double along = dot(reference_of(a, node), direction);
            if (!(std::fabs(along - place) <= half_width)) continue;
            found.nodes.push_back(node);
            found.place += along;
        }
    }
    if (found.nodes.empty()) refuse("nodes in a section", 0.0, "", "must be at least 1");
    found.place /= static_cast<double>(found.nodes.size());
    return found;
}

double mean_way(const Array<double>& moved, const std::vector<int>& nodes, Vector direction)
{
    if (nodes.empty()) refuse("nodes of a gauge", 0.0, "", "must be at least 1");
    double sum = 0.0;
    for (int node : nodes) {
        need_node(moved, node);
        sum += dot(vector_at(moved, node), direction);
    }
    return sum / static_cast<double>(nodes.size());
}

}  // namespace flexpm
