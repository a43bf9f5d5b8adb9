// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/parts/solid_patches.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/parts/node_sets.hpp>
#include <flexpm/kernel/parts/plate_springs.hpp>
#include <flexpm/kernel/parts/solid_jaws.hpp>
#include <flexpm/kernel/parts/solid_plates.hpp>
#include <flexpm/kernel/parts/surface_pieces.hpp>
#include <flexpm/kernel/space_lanes/solid_access.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace flexpm {

namespace {

/// Largest slope of a face to a seated plate, whose turns are small.
constexpr double steepest = 0.5;
/// Looks at all contacts until a plate lies, for each of them: more are none that helps.
constexpr std::size_t most_looks = 10;

/// What lies in a box.
std::vector<HalfSpace> box_of(const SolidPatch& patch)
{
    std::vector<HalfSpace> box;
    for (const Vector along : { Vector { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 } }) {
        box.push_back({ -1.0 * along, -dot(along, patch.low) });
        box.push_back({ along, dot(along, patch.high) });
    }
    return box;
}

/// A contact as a plate sees it that turns on its seat, which is at the origin.
struct SeatPoint {
    Point arm;   ///< along both axes of its turns [m]
    double gap;  ///< [m]
};

/// Shares of three corners in a place of their plane.
std::array<double, 3> shares_in(const std::array<SeatPoint, 3>& corners, Point place)
{
    std::array<double, 3> shares {};
    double whole = 0.0;
    for (int k = 0; k < 3; ++k) {
        shares[k] = cross(corners[(k + 1) % 3].arm - place, corners[(k + 2) % 3].arm - place);
        whole += shares[k];
    }
    for (double& share : shares)
        share /= whole;
    return shares;
}

/// Gap of the plane of three contacts at a place.
double height_at(const std::array<SeatPoint, 3>& corners, Point place)
{
    const auto shares = shares_in(corners, place);
    return shares[0] * corners[0].gap + shares[1] * corners[1].gap + shares[2] * corners[2].gap;
}

/// The three contacts on which a plate lies that was let down at its seat: the seat is over them,
/// and no contact is nearer than their plane. A contact that is takes the place of one of three, by
/// the simplex method; at first these are far out, and high.
/// @param on    what it lies on at first
/// @param none  distance that is round-off [m]
std::array<SeatPoint, 3> lain_on(
    const std::vector<SeatPoint>& points, std::array<SeatPoint, 3> on, double none)
{
    for (std::size_t look = 0; look < most_looks * points.size(); ++look) {
        const SeatPoint* nearest = nullptr;
        double below = none;
        for (const SeatPoint& p : points) {
            const double depth = height_at(on, p.arm) - p.gap;
            if (!(depth > below)) continue;
            below = depth;
            nearest = &p;
        }
        if (!nearest) break;
        const auto seat = shares_in(on, {}), next = shares_in(on, nearest->arm);
        int leaves = -1;
        for (int k = 0; k < 3; ++k)
            if (next[k] > no_gap && (leaves < 0 || seat[k] * next[leaves] < seat[leaves] * next[k]))
                leaves = k;
        on[leaves] = *nearest;
    }
    return on;
}

/// Let a plate turn about the middle of its face, and lay it down on what is before it, as it lies
/// before it is loaded. One that is bonded lies on all of its contacts as it is.
/// @param places  of its contacts [m]
void seat(Plate& p, const std::vector<Vector>& places)
{
    const auto [first, second] = seat_axes(p.normal);
    const double size = std::sqrt(p.face_area);
    std::vector<SeatPoint> points;
    double reach = 0.0, high = 0.0;
    p.seated = true;
    for (std::size_t i = 0; i < places.size(); ++i) {
        Vector arm = cross(places[i] - p.position, p.normal);
        if (norm(arm) < no_gap * size) arm = {};
        p.points[i].arm = arm;
        points.push_back({ { dot(arm, first), dot(arm, second) }, p.points[i].gap });
        reach = std::max(reach, norm(arm));
        high = std::max(high, p.points[i].gap);
    }
    const double far = 10.0 * reach, above = 1e6 * (high + size);
    const auto on = lain_on(points,
        { SeatPoint { { far, 0.0 }, above }, SeatPoint { { -0.5 * far, 0.8 * far }, above },
            SeatPoint { { -0.5 * far, -0.8 * far }, above } },
        no_gap * size);
    for (const SeatPoint& corner : on) {
        if (corner.gap < above) continue;
        refuse("contacts of a seated plate", static_cast<double>(places.size()), "",
            "must be >= 3 around its middle, not on a line; use a larger plate");
    }
    if (p.bonded) return;
    const double at_seat = height_at(on, {});
    p.turn = ((height_at(on, { reach, 0.0 }) - at_seat) / reach) * first
        + ((height_at(on, { 0.0, reach }) - at_seat) / reach) * second;
    if (!(norm(p.turn) <= steepest)) {
        refuse("slope of what is before a seated plate", norm(p.turn), "",
            "must be <= " + number(steepest) + "; give another normal");
    }
    const double face = dot(p.normal, places.front()) - p.points.front().gap + at_seat;
    p.position = p.position + (face - dot(p.normal, p.position)) * p.normal;
    for (PlatePoint& point : p.points) {
        const double turned = dot(point.arm, p.turn);
        point.gap -= at_seat;
        if (std::fabs(point.gap - turned) < no_gap * size) point.gap = turned;  // it lies there
        point.opening = point.gap - turned;
    }
}

Plate plate_before(const SolidState& s, const SolidPatch& patch)
{
    check_not_negative("friction of a plate", patch.friction, "");
    if (patch.bonded && patch.friction > 0.0)
        refuse("friction of a plate", patch.friction, "",
            "must be 0 for a bonded plate; leave it out");
    if (!(std::fabs(norm(patch.normal) - 1.0) < no_gap))
        refuse("normal of a plate", norm(patch.normal), "", "must be a unit vector");
    Plate p = plain_plate(s, SolidSide::bottom);
    p.side = -1;
    lay_strip(p, patch.strip);
    p.normal = patch.normal;
    p.bonded = patch.bonded;
    double nearest = std::numeric_limits<double>::infinity();
    std::vector<Vector> places;
    const std::vector<HalfSpace> box = box_of(patch);
    for (int t = 0; t < static_cast<int>(s.surface.grain.size()); ++t) {
        const Vector outwards = area_vector(s, t);
        if (!faces(p, outwards)) continue;
        const Piece piece = piece_of(s, t, box);
        if (piece.share == 0.0) continue;
        add_touch(s, p, t, piece);
        PlatePoint& point = p.points.back();
        p.face_area += point.area;
        p.position = p.position + point.area * piece.place;
        point.gap = dot(p.normal, piece.place);
        places.push_back(piece.place);
        nearest = std::min(nearest, point.gap);
    }
    if (p.points.empty()) {
        refuse("triangles before a plate", 0.0, "", "must be > 0; place it on the specimen");
    }
    p.position = (1.0 / p.face_area) * p.position;
    const double none = no_gap * norm(patch.high - patch.low);
    set_gaps(p, nearest, p.bonded ? std::numeric_limits<double>::infinity() : none);
    if (patch.friction > 0.0) roughen(p, patch.friction);
    if (patch.seated) seat(p, places);
    return p;
}

}  // namespace

int add_patch_plate(SolidState& s, const SolidPatch& patch)
{
    const Plate plate = plate_before(s, patch);
    require_apart(s, plate);
    require_bare(s, plate);
    return add_plate(s, plate);
}

int add_wall(SolidState& s, Vector position, Vector normal, double friction)
{
    check_not_negative("friction of a plate", friction, "");
    check_positive("length of the plate's normal", norm(normal), "");
    Plate p = plain_plate(s, SolidSide::bottom);
    p.side = -1;
    p.normal = (1.0 / norm(normal)) * normal;
    p.position = position;
    for (int t = 0; t < static_cast<int>(s.surface.grain.size()); ++t) {
        const double area = norm(area_vector(s, t)), none = no_gap * std::sqrt(area);
        for (int k = 0; k < 3; ++k) {
            PlatePoint point;
            point.facet = t;
            point.weights[k] = 1.0;
            point.area = area / 3.0;
            point.normal = p.normal;
            const Vector x = space_vector(s.grains.reference, s.surface.nodes[t][k]);
            const double gap = dot(p.normal, x - position);
            point.gap = point.opening = std::fabs(gap) < none ? 0.0 : gap;
            p.points.push_back(point);
        }
    }
    const double least = least_gap(p);
    if (!(least >= 0.0)) refuse("gap between wall and grains", least, "m", "must not be below 0");
    if (friction > 0.0) roughen(p, friction);
    return add_plate(s, p);
}

int find_patch_plate(const SolidState& s, const SolidPatch& patch)
{
    return find_alike(s.plates, plate_before(s, patch));
}

}  // namespace flexpm
