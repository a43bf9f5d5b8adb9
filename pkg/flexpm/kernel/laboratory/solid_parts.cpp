// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/solid_parts.hpp>

#include <flexpm/kernel/assembly/solid_plan.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/laboratory/softening_ahead.hpp>
#include <flexpm/kernel/laboratory/solid_drive.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/parts/node_sets.hpp>
#include <flexpm/kernel/parts/plate_springs.hpp>
#include <flexpm/kernel/parts/rigid_support.hpp>
#include <flexpm/kernel/parts/soft_plate.hpp>
#include <flexpm/kernel/parts/solid_jaws.hpp>
#include <flexpm/kernel/parts/solid_plates.hpp>
#include <flexpm/kernel/parts/surface_pieces.hpp>
#include <flexpm/kernel/space_lanes/solid_access.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace flexpm {

namespace {

/// Gap over the size of the box that is none: round-off [-].
constexpr double no_gap = 1e-9;
/// Largest slope of a face to a seated plate, whose turns are small.
constexpr double steepest = 0.5;
/// Looks at all contacts until a plate lies, for each of them: more are none that helps.
constexpr std::size_t most_looks = 10;
/// Strain at which all is linear, but no round-off, and such a part of the way to the first
/// softening, where the length of a test is none of the specimen's [-].
constexpr double small_strain = 1e-7, small_part = 0.1;

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

/// Growth of the forces of plates along a direction as grains move [N/s].
double push_rate(const SolidState& s, const std::vector<int>& plates, Vector direction,
    const Array<double>& velocity)
{
    double sum = 0.0;
    for (int number : plates) {
        const Plate& plate = s.plates[number];
        const PlateRates follows = rates_of(s, plate, velocity);
        for (int i = 0; i < static_cast<int>(plate.facets.size()); ++i) {
            if (!(plate.bonded || plate.opening[i] < 0.0)) continue;
            const auto& nodes = s.surface.nodes[plate.facets[i]];
            Vector way = follows.give * plate.normal - plate.velocity;
            for (int k = 0; k < 3; ++k)
                way = way + corner_share(plate, i, k) * space_vector(velocity, nodes[k]);
            const Vector normal = point_normal(plate, i), across = dot(normal, way) * normal;
            const Vector opens = across - dot(point_arm(plate, i), follows.turn) * normal;
            sum -= point_stiffness(plate, i) * dot(opens, direction)
                + sliding_stiffness(plate, i) * dot(way - across, direction);
        }
    }
    return sum;
}

double mean_radius(const SolidState& s)
{
    return grain_mean(s.grains, [&](int g) { return s.grains.radius[g]; });
}

/// Where the elastic solution takes a specimen, for a way so small that all is linear.
SolidPartState moved_state(SolidState s, const PartGeometry& parts, double dt)
{
    check_parts(s, parts);
    const SolidField field = elastic_field(s, drive_of(parts));
    SolidPartState found { std::move(s) };
    found.softening = elastic_strain(found.state, field, 1.0);  // a way: the field is that of 1 m
    found.way = std::min(small_strain * parts.length, small_part * found.softening);
    start(found.state, drive_of(parts), field, found.way, 1.0, true, dt);
    update_node_sets(found.state, 0.0, 0.0);
    found.load = part_load(found.state, parts);
    return found;
}

/// Refuse parts that leave the specimen free to follow those that are driven.
/// @throws std::invalid_argument  naming how it moves
void require_resistance(const SolidState& s, const PartGeometry& parts)
{
    const CentreExtent extent = centre_extent(s.grains);
    RigidSupport support(extent.middle, extent.size);
    double stiffest = 1.0;
    const std::vector<int>& driven = parts.driven;
    for (int number = 0; number < static_cast<int>(s.plates.size()); ++number) {
        const Plate& plate = s.plates[number];
        const bool loads = std::find(driven.begin(), driven.end(), number) != driven.end();
        if (plate.loaded && !loads) continue;
        const Vector way = loads ? parts.direction : Vector {};
        for (int i = 0; i < static_cast<int>(plate.facets.size()); ++i) {
            if (!(plate.bonded || plate.opening[i] <= 0.0)) continue;
            const auto& nodes = s.surface.nodes[plate.facets[i]];
            Vector place;
            for (int k = 0; k < 3; ++k)
                place =
                    place + corner_share(plate, i, k) * space_vector(s.grains.reference, nodes[k]);
            const Vector normal = point_normal(plate, i);
            const double stiffness = point_stiffness(plate, i);
            stiffest = std::max(stiffest, stiffness);
            // what turns on its seat bears there alone
            support.add(plate.seated ? plate.position : place, normal, stiffness, dot(normal, way));
            for (const Vector& along : seat_axes(normal))
                support.add(place, along, sliding_stiffness(plate, i), dot(along, way));
        }
    }
    const SolidDrive drive = drive_of(parts);
    std::vector<Vector> ways(s.node_sets.size());
    drive.for_each_set([&](int set, double sense) { ways[set] = sense * drive.direction; });
    const Vector axes[] = { { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 } };
    for (std::size_t number = 0; number < s.node_sets.size(); ++number) {
        const NodeSet& set = s.node_sets[number];
        for (int node : set.nodes) {
            const Vector place = space_vector(s.grains.reference, node);
            const Vector way = drive.turns ? cross(ways[number], place - set.pivot) : ways[number];
            for (int axis = 0; axis < 3; ++axis)
                if (set.holds(axis)) support.add(place, axes[axis], stiffest, dot(axes[axis], way));
        }
    }
    support.require_resistance();
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
    const double size = std::sqrt(p.width);
    std::vector<SeatPoint> points;
    double reach = 0.0, high = 0.0;
    p.seated = true;
    for (std::size_t i = 0; i < places.size(); ++i) {
        Vector arm = cross(places[i] - p.position, p.normal);
        if (norm(arm) < no_gap * size) arm = {};
        p.arms.insert(p.arms.end(), { arm.x, arm.y, arm.z });
        points.push_back({ { dot(arm, first), dot(arm, second) }, p.gap[i] });
        reach = std::max(reach, norm(arm));
        high = std::max(high, p.gap[i]);
    }
    const double far = 10.0 * reach, above = 1e6 * (high + size);
    const auto on = lain_on(points,
        { SeatPoint { { far, 0.0 }, above }, SeatPoint { { -0.5 * far, 0.8 * far }, above },
            SeatPoint { { -0.5 * far, -0.8 * far }, above } },
        no_gap * size);
    for (const SeatPoint& corner : on) {
        if (corner.gap < above) continue;
        refuse("contacts of a seated plate", static_cast<double>(places.size()), "",
            "must be at least 3, not in a line, around its middle");
    }
    if (p.bonded) return;
    const double at_seat = height_at(on, {});
    p.turn = ((height_at(on, { reach, 0.0 }) - at_seat) / reach) * first
        + ((height_at(on, { 0.0, reach }) - at_seat) / reach) * second;
    if (!(norm(p.turn) <= steepest)) {
        refuse("slope of what is before a seated plate", norm(p.turn), "",
            "must be <= " + number(steepest) + "; give another normal");
    }
    const double face = dot(p.normal, places.front()) - p.gap.front() + at_seat;
    p.position = p.position + (face - dot(p.normal, p.position)) * p.normal;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const double turned = dot(point_arm(p, static_cast<int>(i)), p.turn);
        p.gap[i] -= at_seat;
        if (std::fabs(p.gap[i] - turned) < no_gap * size) p.gap[i] = turned;  // it lies there
        p.opening[i] = p.gap[i] - turned;
    }
}

Plate plate_before(const SolidState& s, const SolidPatch& patch)
{
    check_not_negative("friction of a plate", patch.friction, "");
    if (patch.bonded && patch.friction > 0.0)
        refuse("friction of a plate", patch.friction, "", "must be 0 of one that is bonded");
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
        p.width += p.area.back();
        p.position = p.position + p.area.back() * piece.place;
        p.gap.push_back(dot(p.normal, piece.place));
        places.push_back(piece.place);
        nearest = std::min(nearest, p.gap.back());
    }
    if (p.facets.empty()) {
        refuse("triangles before a plate", 0.0, "", "must be above 0; lay it on the specimen");
    }
    p.position = (1.0 / p.width) * p.position;
    const double none = no_gap * norm(patch.high - patch.low);
    for (double& gap : p.gap)
        gap = p.bonded || gap - nearest < none ? 0.0 : gap - nearest;
    p.opening = p.gap;
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

int find_patch_plate(const SolidState& s, const SolidPatch& patch)
{
    return find_alike(s.plates, plate_before(s, patch));
}

SolidDrive drive_of(const PartGeometry& parts)
{
    return { parts.driven, parts.turns() ? parts.turn : parts.direction, 1.0, parts.driven_sets,
        parts.back_sets, parts.turns() };
}

SolidPartState elastic_part_state(const SolidState& s, const PartGeometry& parts, double dt)
{
    SolidState held = s;
    hold_touching(held);
    return moved_state(std::move(held), parts, dt);
}

SolidPartState pressed_part_state(
    const SolidState& s, const PartGeometry& parts, const std::vector<PlatePressure>& pressures)
{
    SolidDrive drive = drive_of(parts);
    drive.length = 0.0;  // what loads stays
    for (const auto& [plate, pressure] : pressures) {
        check_not_negative("pressure on a plate", pressure, "Pa");
        drive.loads.push_back({ plate, pressure * s.plates.at(plate).width });
    }
    const SolidField field = elastic_field(s, drive);
    SolidPartState found { s };
    hold_touching(found.state);
    double farthest = 0.0;
    for (const Vector& way : field.ways)
        farthest = std::max(farthest, norm(way));
    check_positive("way of the grains under pressures", farthest, "m");
    found.softening = elastic_strain(s, field, 1.0);
    found.way = std::min(small_strain * mean_radius(s) / farthest, small_part * found.softening);
    for (std::size_t i = 0; i < found.state.plates.size(); ++i) {
        Plate& plate = found.state.plates[i];
        const PlateMotion motion = field.of_plate(i);
        plate.displacement = found.way * motion.way * plate.normal;
        if (plate.seated) plate.turn = plate.turn + found.way * motion.turn;
    }
    begin_from(found.state, field, found.way, 0.0);
    update_node_sets(found.state, 0.0, 0.0);
    found.load = part_load(found.state, parts);
    return found;
}

double part_load_rate(const SolidState& s, const PartGeometry& parts, const Array<double>& velocity)
{
    if (!parts.driven.empty()) return push_rate(s, parts.driven, parts.direction, velocity);
    return -push_rate(s, parts.holding, drive_of(parts).direction, velocity);
}

TestScales solid_part_scales(
    const SolidState& s, const PartGeometry& parts, double strength, double dt)
{
    check_not_negative("strength", strength, "Pa");
    SolidState specimen = s;
    for (Plate& plate : specimen.plates)
        plate.machine_stiffness = 0.0;
    check_parts(specimen, parts);
    require_resistance(specimen, parts);
    const SolidPartState moved = moved_state(std::move(specimen), parts, dt);
    const double stiffness = moved.load / moved.way, softening = moved.softening;
    if (!(stiffness > 0.0)) {
        refuse("stiffness that the driven parts feel", stiffness, "N/m",
            "must be > 0; hold against them what is not cut off from them");
    }
    const double mass = 2.0 * kinetic_of_velocities(moved.state);
    const double width = std::sqrt(parts.area);
    return scales_of_parts(s.grains, parts, { mass, stiffness, softening }, strength,
        scale_inputs(s, Sense::compression, width, dt), width);
}

}  // namespace flexpm
