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
    const std::size_t count = p.arms.size();
    double ahead = std::numeric_limits<double>::infinity();  // way of the seat until it lies
    for (std::size_t i = 0; i < count; ++i) {
        if (p.arms[i] == 0.0) ahead = std::min(ahead, p.gap[i]);
        for (std::size_t j = 0; j < count && p.arms[i] < 0.0; ++j) {
            if (!(p.arms[j] > 0.0)) continue;
            const double part = p.arms[j] / (p.arms[j] - p.arms[i]);
            ahead = std::min(ahead, part * p.gap[i] + (1.0 - part) * p.gap[j]);
        }
    }
    double least = -std::numeric_limits<double>::infinity(), most = -least;
    for (std::size_t i = 0; i < count; ++i) {
        p.gap[i] -= ahead;
        if (p.arms[i] < 0.0) least = std::max(least, p.gap[i] / p.arms[i]);
        if (p.arms[i] > 0.0) most = std::min(most, p.gap[i] / p.arms[i]);
    }
    p.turn.z = std::max(least, std::min(most, 0.0));
    p.position = p.position + ahead * p.normal;
    for (std::size_t i = 0; i < count; ++i)
        p.opening[i] = p.gap[i] - p.arms[i] * p.turn.z;
}

/// Part of its facet that a plate takes, its first and last place, 0 at the facet's start.
std::pair<double, double> taken_part(const Assembly& a, const Plate& p, std::size_t facet)
{
    double area = 0.0, middle = 0.0;
    for (int i = 0; i < p.points; ++i) {
        const double part = p.area[facet * p.points + i];
        area += part;
        middle += plate_weight(p, i) * part / facet_area(a, p.facets[facet]);
    }
    const double taken = area / facet_area(a, p.facets[facet]);
    middle = taken > 0.0 ? middle / taken : 0.0;
    return { middle - 0.5 * taken, middle + 0.5 * taken };
}

/// Least part of a facet that counts as lain on twice; less is round-off.
constexpr double lain_on = 1e-9;

/// Whether two plates take a part of a facet both. Walls and plates that touch a point take none.
bool overlap(const Assembly& a, const Plate& p, const Plate& q)
{
    if (p.width == 0.0 || q.width == 0.0) return false;
    for (std::size_t e = 0; e < p.facets.size(); ++e) {
        const auto other =
            std::find(q.facets.begin(), q.facets.end(), p.facets[e]) - q.facets.begin();
        if (other == static_cast<std::ptrdiff_t>(q.facets.size())) continue;
        const auto one = taken_part(a, p, e), two = taken_part(a, q, other);
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

int points_on_facet(const Assembly& a, const Plate& p)
{
    return a.grains.is_rigid(a.facets.grain[p.facets.front()]) ? 1 : 2;
}

void lay(const Assembly& a, Plate& p)
{
    for (int e : p.facets) {
        const FacetPlace facet = facet_place(a, e);
        for (int i = 0; i < p.points; ++i) {
            const Point x = facet.at(plate_weight(p, i));
            // a bonded point is unloaded where it is; a point of the face itself has no gap
            const double gap = along(p.normal, x) - along(p.normal, p.position);
            const bool on_face = p.bonded || std::fabs(gap) < 1e-9 * facet.length();
            p.gap.push_back(on_face ? 0.0 : gap);
            p.area.push_back(facet_area(a, e) / p.points);
        }
    }
    p.opening = p.gap;
    p.shear_force.assign(p.gap.size(), 0.0);
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
        const PlatePoint point = plate_point(p, i);
        const Point x =
            vector_on_edge(a.grains.reference, a.facets.nodes(point.facet), point.weight);
        const double arm = cross(x - middle, in_plane(p.normal));
        // a point at the seat itself has none, or round-off would turn the plate out of its way
        p.arms.push_back(std::fabs(arm) < 1e-9 * p.width ? 0.0 : arm);
    }
    if (std::all_of(p.arms.begin(), p.arms.end(), [](double arm) { return arm == 0.0; }))
        refuse("points of a seated plate", plate_points(p), "", "must be at least 2, apart");
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
                    + ", must not: both would bear; take another part of the outline");
        }
    }
    std::vector<int> numbers;
    for (const Plate& p : plates) {
        numbers.push_back(static_cast<int>(a.plates.size()));
        a.plates.push_back(p);
    }
    return numbers;
}

}  // namespace flexpm
