// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Points of plates, seats, and where two plates would take the same facet.
#include <flexpm/kernel/parts/plate_lay.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/parts/node_sets.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace flexpm {

namespace {

/// Lay a seated plate down on what is before it, as it lies before it is loaded: on a point on
/// either side of its seat. A plate that is bonded lies on all of its points as it is.
void lay_down(Plate& p)
{
    double ahead = std::numeric_limits<double>::infinity();  // way of the seat until it lies
    for (const PlatePoint& one : p.points) {
        const double arm = one.arm.z;
        if (arm == 0.0) ahead = std::min(ahead, one.gap);
        if (!(arm < 0.0)) continue;
        for (const PlatePoint& other : p.points) {
            if (!(other.arm.z > 0.0)) continue;
            const double part = other.arm.z / (other.arm.z - arm);
            ahead = std::min(ahead, part * one.gap + (1.0 - part) * other.gap);
        }
    }
    double least = -std::numeric_limits<double>::infinity(), most = -least;
    for (PlatePoint& point : p.points) {
        const double arm = point.arm.z;
        point.gap -= ahead;
        if (arm < 0.0) least = std::max(least, point.gap / arm);
        if (arm > 0.0) most = std::min(most, point.gap / arm);
    }
    p.turn.z = std::max(least, std::min(most, 0.0));
    p.position = p.position + ahead * p.normal;
    for (PlatePoint& point : p.points)
        point.opening = point.gap - point.arm.z * p.turn.z;
}

/// Index of the first point behind those of one facet.
std::size_t end_of_facet(const Plate& p, std::size_t first)
{
    std::size_t end = first;
    while (end < p.points.size() && p.points[end].facet == p.points[first].facet)
        ++end;
    return end;
}

/// Part of its facet that a plate takes, its first and last place, 0 at the facet's start.
/// @param first  index of the facet's first point
std::pair<double, double> taken_part(const Assembly& a, const Plate& p, std::size_t first)
{
    const double whole = facet_area(a, p.points[first].facet);
    double area = 0.0, middle = 0.0;
    for (std::size_t i = first; i < end_of_facet(p, first); ++i) {
        area += p.points[i].area;
        middle += p.points[i].weights[1] * p.points[i].area / whole;
    }
    const double taken = area / whole;
    middle = taken > 0.0 ? middle / taken : 0.0;
    return { middle - 0.5 * taken, middle + 0.5 * taken };
}

/// Least part of a facet that counts as lain on twice; less is round-off.
constexpr double lain_on = 1e-9;

/// Whether two plates take a part of a facet both. Walls and plates that touch a point take none.
bool overlap(const Assembly& a, const Plate& p, const Plate& q)
{
    if (p.width == 0.0 || q.width == 0.0) return false;
    for (std::size_t first = 0; first < p.points.size(); first = end_of_facet(p, first)) {
        const auto other = std::find_if(q.points.begin(), q.points.end(),
            [&](const PlatePoint& there) { return there.facet == p.points[first].facet; });
        if (other == q.points.end()) continue;
        const auto one = taken_part(a, p, first), two = taken_part(a, q, other - q.points.begin());
        if (std::min(one.second, two.second) - std::max(one.first, two.first) > lain_on)
            return true;
    }
    return false;
}

}  // namespace

Plate plate_of(const Assembly& a, Point normal, const PlateContact& contact)
{
    check_not_negative("plate stiffness", contact.stiffness, "Pa/m");
    check_not_negative("plate friction", contact.friction, "");
    const double normal_stiffness =
        grain_mean(a.grains, [&](int g) { return own_law(a, g).normal_stiffness; });
    const double shear_stiffness =
        grain_mean(a.grains, [&](int g) { return own_law(a, g).shear_stiffness; });
    Plate p;
    p.normal = normal;
    p.stiffness = contact.stiffness > 0.0 ? contact.stiffness : normal_stiffness;
    if (contact.strip != 0.0) {
        check_positive("stiffness of a strip", contact.strip, "Pa/m");
        p.strip = contact.strip;
        p.stiffness = 1.0 / (1.0 / p.stiffness + 1.0 / p.strip);
    }
    p.shear_stiffness = p.stiffness * shear_stiffness / normal_stiffness;
    p.friction = contact.friction;
    p.bonded = contact.bonded;
    p.seated = contact.seated;
    return p;
}

TouchAt points_on(const Assembly& a, const std::vector<int>& facets)
{
    return a.grains.is_rigid(a.facets.grain[facets.front()]) ? TouchAt::middle : TouchAt::ends;
}

PlatePoint point_on_edge(const Plate& p, int facet, double weight)
{
    PlatePoint point;
    point.facet = facet;
    point.weights = { 1.0 - weight, weight, 0.0 };
    point.normal = p.normal;
    return point;
}

void lay_on_edges(const Assembly& a, Plate& p, const std::vector<int>& facets, TouchAt points)
{
    const bool whole = points == TouchAt::middle;
    for (int e : facets) {
        const FacetPlace facet = facet_place(a, e);
        for (double weight : weights_of(points)) {
            PlatePoint point = point_on_edge(p, e, weight);
            // a bonded point is unloaded where it is; a point of the face itself has no gap
            const double gap = along(p.normal, facet.at(weight)) - along(p.normal, p.position);
            const bool on_face = p.bonded || std::fabs(gap) < 1e-9 * facet.length();
            point.whole = whole;
            point.gap = point.opening = on_face ? 0.0 : gap;
            point.area = facet_area(a, e) / (whole ? 1 : 2);
            p.points.push_back(point);
        }
    }
}

void centre_position(const Assembly& a, Plate& p)
{
    const Point tangent = tangent_of(in_plane(p.normal));
    const Point middle = middle_of_face(a, p);
    p.position = p.position + along(tangent, middle - in_plane(p.position)) * tangent;
}

void seat(const Assembly& a, Plate& p)
{
    if (!p.seated) return;
    const Point middle = middle_of_face(a, p);
    for (int i = 0; i < plate_points(p); ++i) {
        const EdgePoint point = edge_point(p, i);
        const Point x =
            vector_on_edge(a.grains.reference, a.facets.nodes(point.facet), point.weight);
        const double arm = cross(x - middle, in_plane(p.normal));
        // a point at the seat itself has none, or round-off would turn the plate out of its way
        p.points[i].arm.z = std::fabs(arm) < 1e-9 * p.width ? 0.0 : arm;
    }
    if (std::all_of(p.points.begin(), p.points.end(),
            [](const PlatePoint& point) { return point.arm.z == 0.0; }))
        refuse("points of a seated plate", plate_points(p), "",
            "must be >= 2 at different positions; use a longer plate");
    lay_down(p);
}

Point unit(Point normal)
{
    const double size = std::hypot(normal.x, normal.y);
    check_positive("length of the plate's normal", size, "");
    return { normal.x / size, normal.y / size };
}

std::vector<int> add_plates(Assembly& a, const std::vector<Plate>& plates)
{
    for (const Plate& p : plates) {
        require_apart(a, p);
        for (std::size_t i = 0; i < a.plates.size(); ++i) {
            if (!overlap(a, p, a.plates[i])) continue;
            refuse("plate", place(p.position),
                "lies on plate " + std::to_string(i)
                    + ", must not: both would carry the load; use another part of the outline");
        }
    }
    std::vector<int> numbers;
    for (const Plate& p : plates) {
        numbers.push_back(static_cast<int>(a.plates.size()));
        a.plates.push_back(p);
        a.plates.back().face_area = a.area_of(p.width);
    }
    return numbers;
}

}  // namespace flexpm
