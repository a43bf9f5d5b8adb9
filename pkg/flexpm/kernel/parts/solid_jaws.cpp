// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/parts/solid_jaws.hpp>

#include <flexpm/kernel/assembly/solid_plan.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/parts/node_sets.hpp>
#include <flexpm/kernel/parts/solid_plates.hpp>
#include <flexpm/kernel/parts/surface_pieces.hpp>
#include <flexpm/kernel/space_lanes/solid_access.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace flexpm {

namespace {

/// Area over that of a triangle that is none: round-off [-].
constexpr double no_area = 1e-9;

/// Largest angle of a jaw: a facet further round does not face it [rad].
constexpr double widest = 2.0944;

constexpr Vector axis { 0.0, 1.0, 0.0 };

constexpr Vector across_axis(Vector v) { return v - dot(v, axis) * axis; }

void check(const SolidJaw& jaw)
{
    check_not_negative("friction of a plate", jaw.friction, "");
    check_positive("angle of a jaw", jaw.angle, "rad");
    check_positive("way from the axis to a jaw", norm(across_axis(jaw.towards)), "m");
    if (jaw.angle > widest)
        refuse("angle of a jaw", jaw.angle, "rad", "must be <= 2 pi / 3; give a smaller angle");
    if (!(jaw.ratio >= 1.0))
        refuse("radius of a jaw over the disc's", jaw.ratio, "", "must be >= 1");
}

/// What lies within an angle about a direction from the axis.
std::vector<HalfSpace> sector(Vector towards, double angle)
{
    const Vector aside = cross(axis, towards);
    const double c = std::cos(0.5 * angle), sine = std::sin(0.5 * angle);
    return { { c * aside - sine * towards, 0.0 }, { -1.0 * (c * aside) - sine * towards, 0.0 } };
}

/// A plate that touches the mantle where this reaches farthest against its normal.
Plate touching_plate(const SolidState& s, SolidSide side)
{
    Plate p = plain_plate(s, side);
    for (int t = 0; t < static_cast<int>(s.surface.side.size()); ++t) {
        if (s.surface.side[t] != static_cast<int>(SolidSide::mantle)) continue;
        const Vector outwards = area_vector(s, t);
        if (faces(p, outwards)) add_contact(s, p, t);
    }
    if (p.points.empty())
        refuse("add_disc_plates: triangles before side " + std::to_string(p.side), 0.0, "",
            "must be above 0; give a disc");
    for (PlatePoint& point : p.points)
        point.gap = dot(p.normal, middle(s.grains.reference, s.surface.nodes[point.facet]));
    const auto first = std::min_element(p.points.begin(), p.points.end(),
        [](const PlatePoint& one, const PlatePoint& other) { return one.gap < other.gap; });
    const double nearest = first->gap;
    p.position = middle(s.grains.reference, s.surface.nodes[first->facet]);
    centre_position(s, p);
    set_gaps(p, nearest, no_gap * std::fabs(nearest));
    return p;
}

void hold(SolidState& s, int node, int axis)
{
    const int i = s.grains.component(node, axis);
    s.grains.velocity[i] = 0.0;
    s.grains.prescribed[i] = 1;
}

/// Keep what a plate touches from sliding across the disc's axis; returns a node of it.
int keep_from_rolling(SolidState& s, const Plate& p)
{
    int held = -1;
    for (const PlatePoint& point : p.points) {
        if (point.gap > 0.0) continue;
        std::array<int, 3> nodes = s.surface.nodes[point.facet];
        if (!s.bodies.empty()) nodes.fill(s.grains.centre(s.surface.grain[point.facet]));
        for (int n : nodes)
            hold(s, n, 0);
        held = nodes.front();
    }
    return held;
}

/// Make a plate that has all of its contacts, before the mantle of a disc about the y axis, a jaw:
/// gaps and normals are those of two circles, the inner one touching each facet.
void bend(const SolidState& s, Plate& p, double disc_radius, double jaw_radius)
{
    p.disc_radius = disc_radius;
    p.jaw_radius = jaw_radius;
    const Vector centre = (jaw_radius - disc_radius) * p.normal;
    for (PlatePoint& point : p.points) {
        const Vector outwards = area_vector(s, point.facet);
        const Vector from = (disc_radius / norm(outwards)) * outwards - centre;
        const double gap = jaw_radius - norm(from);
        point.gap = point.opening = gap < no_gap * jaw_radius ? 0.0 : gap;
        point.normal = (-1.0 / norm(from)) * from;
    }
}

Plate jaw_before(const SolidState& s, const SolidJaw& jaw)
{
    check(jaw);
    Plate p = plain_plate(s, SolidSide::bottom);
    p.side = -1;
    lay_strip(p, jaw.strip);
    const Vector towards = across_axis(jaw.towards);
    p.normal = (-1.0 / norm(towards)) * towards;
    const std::vector<HalfSpace> before = sector(-1.0 * p.normal, jaw.angle);
    double area = 0.0, reach = 0.0, middle = 0.0;
    for (int t = 0; t < static_cast<int>(s.surface.side.size()); ++t) {
        if (s.surface.side[t] != static_cast<int>(SolidSide::mantle)) continue;
        const Vector outwards = area_vector(s, t);
        if (!(dot(p.normal, outwards) < 0.0)) continue;
        const Piece piece = piece_of(s, t, before);
        if (piece.share == 0.0) continue;
        add_touch(s, p, t, piece);
        const double own = p.points.back().area;
        area += own;
        reach += own * dot(piece.place, outwards) / norm(outwards);
        middle += own * piece.place.y;
    }
    if (p.points.empty())
        refuse("triangles before a jaw", 0.0, "",
            "must be > 0; place it on the lateral surface of a disc");
    const double disc_radius = reach / area;
    p.position = -disc_radius * p.normal + (middle / area) * axis;
    bend(s, p, disc_radius, jaw.ratio * disc_radius);
    // it touches the facets whose normals are nearest to its own
    set_gaps(p, least_gap(p), no_gap * p.jaw_radius);
    if (jaw.friction > 0.0) roughen(p, jaw.friction);
    return p;
}

/// Whether a plate has an area of the outside for itself; one of a line has none.
bool covers(const Plate& plate) { return plate.face_area > 0.0 || is_jaw(plate); }

}  // namespace

void add_disc_plates(SolidState& s, double jaw_radius)
{
    check_not_negative("radius of a jaw", jaw_radius, "m");
    if (!s.plates.empty())
        refuse("add_disc_plates: plates", static_cast<double>(s.plates.size()), "", "must be 0");
    std::vector<Plate> plates;
    for (const SolidSide side : { SolidSide::bottom, SolidSide::top })
        plates.push_back(touching_plate(s, side));
    for (Plate& plate : plates) {
        if (jaw_radius == 0.0) continue;
        const double disc_radius = std::fabs(plate.position.z);
        if (!(jaw_radius > disc_radius))
            refuse("radius of a jaw", jaw_radius, "m",
                "must be > " + std::to_string(disc_radius)
                    + " m, the radius of the disc; give a larger radius");
        bend(s, plate, disc_radius, jaw_radius);
    }
    s.plates = plates;
    keep_from_rolling(s, s.plates.back());
    hold(s, keep_from_rolling(s, s.plates.front()), 1);
    prepare_step(s);
}

int add_jaw_plate(SolidState& s, const SolidJaw& jaw)
{
    const Plate plate = jaw_before(s, jaw);
    require_apart(s, plate);
    require_bare(s, plate);
    return add_plate(s, plate);
}

int find_jaw_plate(const SolidState& s, const SolidJaw& jaw)
{
    return find_alike(s.plates, jaw_before(s, jaw));
}

void require_bare(const SolidState& s, const Plate& plate)
{
    std::vector<double> covered(s.surface.side.size(), 0.0);
    for (const Plate& there : s.plates)
        if (covers(there))
            for (const PlatePoint& point : there.points)
                covered[point.facet] += point.area;
    for (const PlatePoint& point : plate.points) {
        const int t = point.facet;
        const double whole = norm(area_vector(s, t));
        if (covered[t] == 0.0 || covered[t] + point.area <= (1.0 + no_area) * whole) continue;
        refuse("area of a triangle before two plates", covered[t] + point.area, "m^2",
            "must be <= its own area; use another position or a smaller part");
    }
}

}  // namespace flexpm
