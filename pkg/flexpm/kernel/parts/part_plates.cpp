// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Supports and jaws find the parts of facets that they bear.
#include <flexpm/kernel/parts/part_plates.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/parts/plate_lay.hpp>
#include <flexpm/kernel/parts/plate_points.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexpm {

namespace {

/// Part of a facet before a patch, between 0 at its start and 1 at its end.
struct CoveredFacet {
    double first, last;
    double gap;  ///< from the patch's place to the middle of the part, along the normal [m]
};

CoveredFacet covered_part(const FacetPlace& facet, Point normal, const Patch& patch)
{
    const Point tangent = tangent_of(normal);
    const double start = along(tangent, facet.start - patch.place);
    const double way = along(tangent, facet.end - patch.place) - start;
    const double half = 0.5 * patch.length;
    // the facet faces the plate, so it goes on along it
    const double one = (-half - start) / way, other = (half - start) / way;
    CoveredFacet part = { std::clamp(std::min(one, other), 0.0, 1.0),
        std::clamp(std::max(one, other), 0.0, 1.0), 0.0 };
    const double middle = 0.5 * (part.first + part.last);
    part.gap = along(normal, facet.start + middle * (facet.end - facet.start) - patch.place);
    return part;
}

/// Normal of the facet of the outline whose middle is nearest to a place.
Point normal_near(const Assembly& a, Point place)
{
    double nearest = std::numeric_limits<double>::infinity();
    Point found = { 0.0, 1.0 };
    for (int e = 0; e < a.facets.count; ++e) {
        if (a.facets.side[e] < 0 || a.grains.erased[a.facets.grain[e]]) continue;
        const FacetPlace facet = facet_place(a, e);
        const double distance = norm(facet.start + 0.5 * (facet.end - facet.start) - place);
        if (!(distance < nearest)) continue;
        nearest = distance;
        found = facet.normal();
    }
    return found;
}

/// Distance of a support's place from the outline, over the length of the facet there, that is
/// none: an arc is made of chords [-].
constexpr double off_outline = 0.05;

double distance_to(const FacetPlace& facet, Point place)
{
    const Point way = facet.way();
    const double part = dot(place - facet.start, way) / dot(way, way);
    return norm(facet.start + std::clamp(part, 0.0, 1.0) * way - place);
}

/// @throws std::invalid_argument  unless a support lies on the outline, with half of its length or
///         more, and ends on it
void require_on_outline(
    const Assembly& a, const Plate& p, const std::vector<int>& facets, const Patch& patch)
{
    const Point tangent = tangent_of(in_plane(p.normal));
    double off = std::numeric_limits<double>::infinity(), length = 0.0, first = off, last = -off;
    for (int e : facets) {
        const FacetPlace facet = facet_place(a, e);
        const double distance = distance_to(facet, patch.place);
        if (distance < off) length = facet.length();
        off = std::min(off, distance);
        for (Point x : { facet.start, facet.end }) {
            first = std::min(first, along(tangent, x - patch.place));
            last = std::max(last, along(tangent, x - patch.place));
        }
    }
    if (!(off <= off_outline * length)) {
        refuse("position of a support", place(patch.place),
            "is " + number(off) + " m off the outline; move it onto the outline");
    }
    const double half = 0.5 * patch.length * (1.0 - 1e-9);
    if (first > -half && last < half) {
        refuse("length of a support", patch.length, "m",
            "must be <= " + number(last - first)
                + " m, the length of its side; give a shorter one");
    }
    if (!(p.width >= half)) {
        refuse("length of a support", patch.length, "m",
            "has " + number(p.width) + " m on the outline, must have half of it there; move it");
    }
}

Plate patch_plate(const Assembly& a, const Patch& patch, const PlateContact& contact)
{
    check_positive("length of a support", patch.length, "m");
    check_finite("position of a support", patch.place.x + patch.place.y, "m");
    const bool given = patch.normal.x != 0.0 || patch.normal.y != 0.0;
    Plate p = plate_of(a, given ? unit(patch.normal) : normal_near(a, patch.place), contact);
    std::vector<int> facets;
    std::vector<CoveredFacet> covered;
    for (int e = 0; e < a.facets.count; ++e) {
        const FacetPlace facet = facet_place(a, e);
        const bool outer = a.facets.side[e] >= 0 && !a.grains.erased[a.facets.grain[e]];
        if (!outer || !(along(p.normal, facet.normal()) > facing)) continue;
        const CoveredFacet part = covered_part(facet, in_plane(p.normal), patch);
        if (part.last > part.first && std::fabs(part.gap) < patch.length) {
            covered.push_back(part);
            facets.push_back(e);
        }
    }
    if (covered.empty()) {
        refuse("edges at a support", 0.0, "",
            "must be >= 1; place the support on the outline with its normal inwards");
    }
    p.position = patch.place;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < covered.size(); ++i) {
        const FacetPlace facet = facet_place(a, facets[i]);
        p.width +=
            (covered[i].last - covered[i].first) * facet.length() * along(p.normal, facet.normal());
        for (const Point x : { facet.start, facet.end }) {
            if (along(p.normal, x) < nearest) p.position = x;
            nearest = std::min(nearest, along(p.normal, x));
        }
    }
    lay_on_edges(a, p, facets, TouchAt::ends);  // of edges of rigid grains, too
    for (std::size_t i = 0; i < covered.size(); ++i) {
        const double part = covered[i].last - covered[i].first;
        const double middle = 0.5 * (covered[i].first + covered[i].last);
        const double area = a.area_of(part * facet_place(a, facets[i]).length());
        p.points[2 * i].area = (1.0 - middle) * area;
        p.points[2 * i + 1].area = middle * area;
    }
    require_on_outline(a, p, facets, patch);
    centre_position(a, p);
    seat(a, p);
    return p;
}

/// Largest angle of a jaw: an edge further round does not face its normal.
constexpr double widest_jaw = 2.0 / 3.0 * pi;

void check(const Jaw& jaw, const PlateContact& contact)
{
    check_finite("position of a jaw", jaw.place.x + jaw.place.y, "m");
    const double least = norm(jaw.centre - jaw.place);
    check_positive("distance of a jaw from the disc's centre", least, "m");
    check_finite("radius of a jaw", jaw.radius, "m");
    if (!(jaw.radius >= least * (1.0 - 1e-9)))
        refuse("radius of a jaw", jaw.radius, "m",
            "must be >= " + number(least) + " m, the radius of the disc; give a larger radius");
    if (!(jaw.angle > 0.0 && jaw.angle <= widest_jaw * (1.0 + 1e-9)))
        refuse("angle of a jaw", jaw.angle, "rad", "must be > 0 and <= 2 pi / 3; correct it");
    if (contact.bonded)
        refuse("bond of a jaw", 1.0, "", "must be 0: a jaw only presses; leave it out");
}

Plate jaw_plate(const Assembly& a, const Jaw& jaw, const PlateContact& contact)
{
    check(jaw, contact);
    Plate p = plate_of(a, unit(jaw.centre - jaw.place), contact);
    p.position = jaw.place;
    p.disc_radius = norm(jaw.centre - jaw.place);
    p.jaw_radius = std::max(jaw.radius, p.disc_radius);
    const Point inwards = in_plane(p.normal), tangent = tangent_of(inwards);
    const double half = 0.5 * jaw.angle, apart = p.jaw_radius - p.disc_radius;
    const auto angle_of = [&](Point x) {
        return std::atan2(along(tangent, x - jaw.centre), -along(inwards, x - jaw.centre));
    };
    for (int e = 0; e < a.facets.count; ++e) {
        const FacetPlace facet = facet_place(a, e);
        const bool outer = a.facets.side[e] >= 0 && !a.grains.erased[a.facets.grain[e]];
        if (!outer || !(along(inwards, facet.normal()) > 0.0)) continue;
        const double start = angle_of(facet.start), way = angle_of(facet.end) - start;
        const double one = (-half - start) / way, other = (half - start) / way;
        const double first = std::clamp(std::min(one, other), 0.0, 1.0);
        const double last = std::clamp(std::max(one, other), 0.0, 1.0);
        if (!(last > first)) continue;
        p.width += (last - first) * facet.length() * along(inwards, facet.normal());
        const double middle = 0.5 * (first + last);
        const double area = a.area_of((last - first) * facet.length());
        for (double weight : weights_of(TouchAt::ends)) {
            PlatePoint point = point_on_edge(p, e, weight);
            point.area = (weight == 0.0 ? 1.0 - middle : middle) * area;
            const double angle = angle_of(weight == 0.0 ? facet.start : facet.end);
            // from the disc's rim, as the jaw's centre sees it, to the arc
            const Point from =
                p.disc_radius * (std::sin(angle) * tangent - std::cos(angle) * inwards)
                - apart * inwards;
            point.gap = p.jaw_radius - norm(from);
            point.normal = unit(-1.0 * from);
            p.points.push_back(point);
        }
    }
    if (p.points.empty())
        refuse("edges at a jaw", 0.0, "", "must be >= 1; place it on the rim of the disc");
    // the rim has a node near the middle, not on it
    const double nearest = least_gap(p);
    for (PlatePoint& point : p.points)
        point.gap = point.opening = apart > 1e-9 * p.disc_radius ? point.gap - nearest : 0.0;
    return p;
}

}  // namespace

int add_patch_plate(Assembly& a, const Patch& patch, const PlateContact& contact)
{
    return add_plates(a, { patch_plate(a, patch, contact) }).front();
}

int find_patch_plate(const Assembly& a, const Patch& patch, const PlateContact& contact)
{
    return find_alike(a.plates, patch_plate(a, patch, contact));
}

int add_jaw_plate(Assembly& a, const Jaw& jaw, const PlateContact& contact)
{
    return add_plates(a, { jaw_plate(a, jaw, contact) }).front();
}

int find_jaw_plate(const Assembly& a, const Jaw& jaw, const PlateContact& contact)
{
    return find_alike(a.plates, jaw_plate(a, jaw, contact));
}

}  // namespace flexpm
