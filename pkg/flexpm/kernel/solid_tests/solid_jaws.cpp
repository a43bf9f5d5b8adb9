// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/solid_tests/solid_jaws.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/solid_tests/solid_sets.hpp>
#include <flexpm/kernel/solid_tests/surface_pieces.hpp>
#include <flexpm/kernel/solids/solid_access.hpp>
#include <flexpm/kernel/solids/solid_plates.hpp>

#include <algorithm>
#include <cmath>

namespace flexpm {

namespace {

/// Area over that of a triangle that is none, and gap over a radius that is none: round-off [-].
constexpr double no_area = 1e-9, no_gap = 1e-9;

/// Largest angle of a jaw: a facet further round does not face it [rad].
constexpr double widest = 2.0944;

constexpr Vector axis { 0.0, 1.0, 0.0 };

constexpr Vector across_axis(Vector v) { return v - dot(v, axis) * axis; }

void check(const SolidJaw& jaw)
{
    check_not_negative("friction of a plate", jaw.friction, "");
    check_positive("angle of a jaw", jaw.angle, "rad");
    check_positive("way from the axis to a jaw", norm(across_axis(jaw.towards)), "m");
    if (jaw.angle > widest) refuse("angle of a jaw", jaw.angle, "rad", "must be <= 2 pi / 3");
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
        area += p.area.back();
        reach += p.area.back() * dot(piece.place, outwards) / norm(outwards);
        middle += p.area.back() * piece.place.y;
    }
    if (p.facets.empty())
        refuse("triangles before a jaw", 0.0, "", "must be above 0; lay it on a disc's mantle");
    const double disc_radius = reach / area;
    p.position = -disc_radius * p.normal + (middle / area) * axis;
    bend(s, p, disc_radius, jaw.ratio * disc_radius);
    // it touches the facets whose normals are nearest to its own
    const double nearest = *std::min_element(p.gap.begin(), p.gap.end());
    for (double& gap : p.gap)
        gap = gap - nearest < no_gap * p.jaw_radius ? 0.0 : gap - nearest;
    p.opening = p.gap;
    if (jaw.friction > 0.0) roughen(p, jaw.friction);
    return p;
}

/// Whether a plate has an area of the outside for itself; one of a line has none.
bool covers(const Plate& plate) { return plate.width > 0.0 || plate.jaw_radius > 0.0; }

}  // namespace

int add_jaw_plate(SolidState& s, const SolidJaw& jaw)
{
    const Plate plate = jaw_before(s, jaw);
    require_apart(s, plate);
    require_bare(s, plate);
    return add_plate(s, plate);
}

int find_jaw_plate(const SolidState& s, const SolidJaw& jaw)
{
    const Plate plate = jaw_before(s, jaw);
    const int found = find_alike(s, plate);
    return found >= 0 && s.plates[found].jaw_radius == plate.jaw_radius ? found : -1;
}

void require_bare(const SolidState& s, const Plate& plate)
{
    std::vector<double> covered(s.surface.side.size(), 0.0);
    for (const Plate& there : s.plates)
        for (std::size_t i = 0; covers(there) && i < there.facets.size(); ++i)
            covered[there.facets[i]] += there.area[i];
    for (std::size_t i = 0; i < plate.facets.size(); ++i) {
        const int t = plate.facets[i];
        const double whole = norm(area_vector(s, t));
        if (covered[t] == 0.0 || covered[t] + plate.area[i] <= (1.0 + no_area) * whole) continue;
        refuse("area of a triangle before two plates", covered[t] + plate.area[i], "m^2",
            "must be at most its own; take another place, or a smaller part");
    }
}

}  // namespace flexpm
