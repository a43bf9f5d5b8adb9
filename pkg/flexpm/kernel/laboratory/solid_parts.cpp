// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/solid_parts.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/laboratory/softening_ahead.hpp>
#include <flexpm/kernel/laboratory/solid_drive.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/parts/node_sets.hpp>
#include <flexpm/kernel/parts/plate_springs.hpp>
#include <flexpm/kernel/parts/rigid_support.hpp>
#include <flexpm/kernel/parts/soft_plate.hpp>
#include <flexpm/kernel/parts/solid_plates.hpp>
#include <flexpm/kernel/space_lanes/solid_access.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace flexpm {

namespace {

/// Strain at which all is linear, but no round-off, and such a part of the way to the first
/// softening, where the length of a test is none of the specimen's [-].
constexpr double linear_strain = 1e-7, small_part = 0.1;

/// Growth of the forces of plates along a direction as grains move [N/s].
double push_rate(const SolidState& s, const std::vector<int>& plates, Vector direction,
    const Array<double>& velocity)
{
    double sum = 0.0;
    for (int number : plates) {
        const Plate& plate = s.plates[number];
        const PlateRates follows = rates_of(s, plate, velocity);
        for (int i = 0; i < plate_points(plate); ++i) {
            if (!(plate.bonded || plate.points[i].opening < 0.0)) continue;
            const auto& nodes = s.surface.nodes[plate.points[i].facet];
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
    s.gravity = {};  // the solution is that of the parts alone
    const SolidField field = elastic_field(s, drive_of(parts));
    SolidPartState found { std::move(s) };
    found.softening = elastic_strain(found.state, field, 1.0);  // a way: the field is that of 1 m
    found.way = std::min(linear_strain * parts.length, small_part * found.softening);
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
        for (int i = 0; i < plate_points(plate); ++i) {
            if (!(plate.bonded || plate.points[i].opening <= 0.0)) continue;
            const auto& nodes = s.surface.nodes[plate.points[i].facet];
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
            const Vector arm = place - set.laid_pivot();
            const Vector way = drive.turns ? cross(ways[number], arm) : ways[number];
            for (int axis = 0; axis < 3; ++axis) {
                if (!set.holds(axis)) continue;
                const double along = dot(axes[axis], way);
                if (set.floats)
                    support.add_turning(arm, axes[axis], stiffest, along);
                else
                    support.add(place, axes[axis], stiffest, along);
            }
        }
    }
    support.require_resistance();
}

}  // namespace

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
        drive.loads.push_back({ plate, pressure * s.plates.at(plate).face_area });
    }
    const SolidField field = elastic_field(s, drive);
    SolidPartState found { s };
    found.state.gravity = {};
    hold_touching(found.state);
    double farthest = 0.0;
    for (const Vector& way : field.ways)
        farthest = std::max(farthest, norm(way));
    check_positive("way of the grains under pressures", farthest, "m");
    found.softening = elastic_strain(s, field, 1.0);
    found.way = std::min(linear_strain * mean_radius(s) / farthest, small_part * found.softening);
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
            "must be > 0: nothing resists them; fix a part that is connected to them, e.g. with "
            "hold()");
    }
    const double mass = 2.0 * kinetic_of_velocities(moved.state);
    const double width = std::sqrt(parts.area);
    return scales_of_parts(s.grains, parts, { mass, stiffness, softening }, strength,
        scale_inputs(s, Sense::compression, width, dt), width);
}

}  // namespace flexpm
