// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Plates find the facets they may touch and where these begin to.
#include <flexpm/kernel/topology/plate_build.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/forces/node_sets.hpp>
#include <flexpm/kernel/forces/plate_contact.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/step/step_plan.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>

namespace flexpm {

namespace {

double along(Vector direction, Vector p) { return dot(direction, p); }

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

/// Points that touch a plate on each facet: grains of either kind, all of one kind.
int points_on_facet(const Assembly& a, const Plate& p)
{
    return a.grains.is_rigid(a.facets.grain[p.facets.front()]) ? 1 : 2;
}

/// Gaps and tributary areas of the plate's points; the state at the reference.
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
    p.angle = std::max(least, std::min(most, 0.0));
    p.position = p.position + ahead * p.normal;
    for (std::size_t i = 0; i < count; ++i)
        p.opening[i] = p.gap[i] - p.arms[i] * p.angle;
}

/// Let a seated plate turn about the middle of its face, where an even pressure has no moment.
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

/// Least cosine between the normals of a plate and of a facet that faces it.
constexpr double facing = 0.5;

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

/// Make facets of the edges that grains share, too; they lie on no side.
void list_inner_facets(Assembly& a)
{
    std::set<int> known;  // first nodes
    for (int e = 0; e < a.facets.count; ++e)
        known.insert(a.facets.nodes(e)[0]);
    for (int g = 0; g < a.grains.count; ++g) {
        const int corners = a.grains.vertices_of(g);
        for (int k = 0; k < corners; ++k) {
            if (known.count(a.grains.node(g, k)) != 0) continue;
            const int e = a.facets.count++;
            a.facets.grain.push_back(g);
            a.facets.side.push_back(-1);
            a.facets.pressure.push_back(0.0);
            a.facets.resize_rows();
            a.facets.set_nodes(e, { a.grains.node(g, k), a.grains.node(g, (k + 1) % corners) });
        }
    }
    prepare_step(a);
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

/// Add plates that lie neither on held nodes nor on another plate; the first one's number.
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

/// The plate that was laid like another one, -1 if none was. What was erased since is missing in
/// both.
int find_like(const Assembly& a, const Plate& p)
{
    for (std::size_t i = 0; i < a.plates.size(); ++i) {
        const Plate& q = a.plates[i];
        const bool alike = q.side == p.side && q.facets == p.facets && q.area == p.area
            && q.normal.x == p.normal.x && q.normal.y == p.normal.y && q.friction == p.friction
            && q.bonded == p.bonded && q.strip == p.strip && q.jaw_radius == p.jaw_radius
            && q.seated == p.seated;
        if (alike) return static_cast<int>(i);
    }
    return -1;
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
void require_on_outline(const Assembly& a, const Plate& p, const Patch& patch)
{
    const Point tangent = tangent_of(in_plane(p.normal));
    double off = std::numeric_limits<double>::infinity(), length = 0.0, first = off, last = -off;
    for (int e : p.facets) {
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
        refuse("place of a support", place(patch.place),
            "is " + number(off) + " m off the outline, must lie on it");
    }
    const double half = 0.5 * patch.length * (1.0 - 1e-9);
    if (first > -half && last < half) {
        refuse("length of a support", patch.length, "m",
            "must be <= " + number(last - first) + " m, which its side has");
    }
    if (!(p.width >= half)) {
        refuse("length of a support", patch.length, "m",
            "has " + number(p.width) + " m on the outline, must have half of it; move its place");
    }
}

std::vector<Plate> side_plates(const Assembly& a, int side, int pieces, const PlateContact& contact)
{
    if (pieces < 1) refuse("plates on a side", pieces, "", "must be at least 1");
    require_side(a, side);
    std::vector<int> facets;
    for (int e = 0; e < a.facets.count; ++e) {
        if (is_on_side(a, e, side)) facets.push_back(e);
    }
    if (facets.empty()) refuse("edges of a side", 0.0, "", "must be at least 1; all are erased");
    const Point normal = facet_place(a, facets.front()).normal();
    const Point direction = tangent_of(normal);
    double first = std::numeric_limits<double>::infinity(), last = -first;
    for (int e : facets) {
        for (Point p : { facet_place(a, e).start, facet_place(a, e).end }) {
            first = std::min(first, along(direction, p));
            last = std::max(last, along(direction, p));
        }
    }
    const double width = (last - first) / pieces;
    std::vector<Plate> plates;
    for (int i = 0; i < pieces; ++i) {
        Plate p = plate_of(a, normal, contact);
        p.side = side;
        p.width = width;
        p.position = facet_place(a, facets.front()).start;
        for (int e : facets) {
            const FacetPlace facet = facet_place(a, e);
            const double middle =
                0.5 * (along(direction, facet.start) + along(direction, facet.end)) - first;
            if (std::clamp(static_cast<int>(middle / width), 0, pieces - 1) == i)
                p.facets.push_back(e);
        }
        if (p.facets.empty()) {
            refuse("plates on a side", pieces, "", "a plate has no edge; take fewer plates");
        }
        p.points = points_on_facet(a, p);
        lay(a, p);
        seat(a, p);
        plates.push_back(p);
    }
    return plates;
}

Plate patch_plate(const Assembly& a, const Patch& patch, const PlateContact& contact)
{
    check_positive("length of a support", patch.length, "m");
    check_finite("place of a support", patch.place.x + patch.place.y, "m");
    const bool given = patch.normal.x != 0.0 || patch.normal.y != 0.0;
    Plate p = plate_of(a, given ? unit(patch.normal) : normal_near(a, patch.place), contact);
    p.points = 2;  // the ends of edges, those of rigid grains, too
    std::vector<CoveredFacet> covered;
    for (int e = 0; e < a.facets.count; ++e) {
        const FacetPlace facet = facet_place(a, e);
        const bool outer = a.facets.side[e] >= 0 && !a.grains.erased[a.facets.grain[e]];
        if (!outer || !(along(p.normal, facet.normal()) > facing)) continue;
        const CoveredFacet part = covered_part(facet, in_plane(p.normal), patch);
        if (part.last > part.first && std::fabs(part.gap) < patch.length) {
            covered.push_back(part);
            p.facets.push_back(e);
        }
    }
    if (covered.empty()) {
        refuse("edges at a support", 0.0, "",
            "at least 1 must face it; lay it on the outline, its normal turned inwards");
    }
    p.position = patch.place;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < covered.size(); ++i) {
        const FacetPlace facet = facet_place(a, p.facets[i]);
        p.width +=
            (covered[i].last - covered[i].first) * facet.length() * along(p.normal, facet.normal());
        for (const Point x : { facet.start, facet.end }) {
            if (along(p.normal, x) < nearest) p.position = x;
            nearest = std::min(nearest, along(p.normal, x));
        }
    }
    lay(a, p);
    for (std::size_t i = 0; i < covered.size(); ++i) {
        const double part = covered[i].last - covered[i].first;
        const double middle = 0.5 * (covered[i].first + covered[i].last);
        const double area = a.area_of(part * facet_place(a, p.facets[i]).length());
        p.area[2 * i] = (1.0 - middle) * area;
        p.area[2 * i + 1] = middle * area;
    }
    require_on_outline(a, p, patch);
    seat(a, p);
    return p;
}

/// Largest angle of a jaw: an edge further round does not face its normal.
constexpr double widest_jaw = 2.0 / 3.0 * pi;

void check(const Jaw& jaw, const PlateContact& contact)
{
    check_finite("place of a jaw", jaw.place.x + jaw.place.y, "m");
    const double least = norm(jaw.centre - jaw.place);
    check_positive("distance of a jaw from the disc's centre", least, "m");
    check_finite("radius of a jaw", jaw.radius, "m");
    if (!(jaw.radius >= least * (1.0 - 1e-9)))
        refuse(
            "radius of a jaw", jaw.radius, "m", "must be >= " + number(least) + " m, the disc's");
    if (!(jaw.angle > 0.0 && jaw.angle <= widest_jaw * (1.0 + 1e-9)))
        refuse("angle of a jaw", jaw.angle, "rad", "must be above 0 and <= 2 pi / 3");
    if (contact.bonded) refuse("bond of a jaw", 1.0, "", "must be 0: a jaw only presses");
}

Plate jaw_plate(const Assembly& a, const Jaw& jaw, const PlateContact& contact)
{
    check(jaw, contact);
    Plate p = plate_of(a, unit(jaw.centre - jaw.place), contact);
    p.points = 2;
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
        p.facets.push_back(e);
        p.width += (last - first) * facet.length() * along(inwards, facet.normal());
        const double middle = 0.5 * (first + last);
        const double area = a.area_of((last - first) * facet.length());
        p.area.insert(p.area.end(), { (1.0 - middle) * area, middle * area });
        for (const Point x : { facet.start, facet.end }) {
            const double angle = angle_of(x);
            // from the disc's rim, as the jaw's centre sees it, to the arc
            const Point from =
                p.disc_radius * (std::sin(angle) * tangent - std::cos(angle) * inwards)
                - apart * inwards;
            p.gap.push_back(p.jaw_radius - norm(from));
            const Point normal = unit(-1.0 * from);
            p.normals.insert(p.normals.end(), { normal.x, normal.y });
        }
    }
    if (p.facets.empty())
        refuse("edges at a jaw", 0.0, "", "must be at least 1; lay it on the rim of the disc");
    // the rim has a node near the middle, not on it
    const double nearest = *std::min_element(p.gap.begin(), p.gap.end());
    for (double& gap : p.gap)
        gap = apart > 1e-9 * p.disc_radius ? gap - nearest : 0.0;
    p.opening = p.gap;
    p.shear_force.assign(p.gap.size(), 0.0);
    return p;
}

}  // namespace

std::vector<int> add_side_plates(Assembly& a, int side, int pieces, const PlateContact& contact)
{
    return add_plates(a, side_plates(a, side, pieces, contact));
}

int add_patch_plate(Assembly& a, const Patch& patch, const PlateContact& contact)
{
    return add_plates(a, { patch_plate(a, patch, contact) }).front();
}

int find_side_plate(const Assembly& a, int side, const PlateContact& contact)
{
    return find_like(a, side_plates(a, side, 1, contact).front());
}

int find_patch_plate(const Assembly& a, const Patch& patch, const PlateContact& contact)
{
    return find_like(a, patch_plate(a, patch, contact));
}

int add_jaw_plate(Assembly& a, const Jaw& jaw, const PlateContact& contact)
{
    return add_plates(a, { jaw_plate(a, jaw, contact) }).front();
}

int find_jaw_plate(const Assembly& a, const Jaw& jaw, const PlateContact& contact)
{
    return find_like(a, jaw_plate(a, jaw, contact));
}

int add_touching_plate(Assembly& a, Point normal, const PlateContact& contact)
{
    Plate p = plate_of(a, unit(normal), contact);
    double nearest = std::numeric_limits<double>::infinity();
    for (int e = 0; e < a.facets.count; ++e) {
        const FacetPlace facet = facet_place(a, e);
        const bool outer = a.facets.side[e] >= 0;
        if (outer && along(p.normal, facet.normal()) > facing) p.facets.push_back(e);
    }
    if (p.facets.empty())
        refuse("plate", 0, "", "no boundary edge faces it; turn its normal inwards");
    p.points = points_on_facet(a, p);
    for (int e : p.facets) {
        const FacetPlace facet = facet_place(a, e);
        for (int i = 0; i < p.points; ++i) {
            const Point x = facet.at(plate_weight(p, i));
            if (along(p.normal, x) < nearest) p.position = x;
            nearest = std::min(nearest, along(p.normal, x));
        }
    }
    lay(a, p);
    a.plates.push_back(p);
    return static_cast<int>(a.plates.size()) - 1;
}

void fix_tangential(Assembly& a, int plate)
{
    require_plate(a, plate);
    const Plate& p = a.plates[plate];
    if (p.gap.empty()) refuse("edges at the plate", 0.0, "", "must be at least 1; all are erased");
    const auto first =
        static_cast<int>(std::min_element(p.gap.begin(), p.gap.end()) - p.gap.begin());
    const int facet = p.facets[first / p.points], grain = a.facets.grain[facet];
    const int node = a.grains.is_rigid(grain)
        ? a.grains.centre(grain)
        : a.facets.nodes(facet)[plate_weight(p, first % p.points) > 0.5];
    const int axis = std::fabs(p.normal.y) > std::fabs(p.normal.x) ? 0 : 1;
    a.grains.prescribed[a.grains.component(node, axis)] = 1;
    a.grains.velocity[a.grains.component(node, axis)] = 0.0;
}

int add_wall(Assembly& a, Point position, Point normal, const PlateContact& contact)
{
    Plate p = plate_of(a, unit(normal), contact);
    p.position = position;
    list_inner_facets(a);
    for (int e = 0; e < a.facets.count; ++e)
        p.facets.push_back(e);
    p.points = 2;  // rigid grains, too, rest on their corners
    lay(a, p);
    const double least = *std::min_element(p.gap.begin(), p.gap.end());
    if (!(least >= 0.0)) refuse("gap between wall and grains", least, "m", "must not be below 0");
    a.plates.push_back(p);
    return static_cast<int>(a.plates.size()) - 1;
}

}  // namespace flexpm
