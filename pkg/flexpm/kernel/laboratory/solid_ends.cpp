// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/solid_ends.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/laboratory/solid_drive.hpp>
#include <flexpm/kernel/laboratory/solid_frame.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/parts/solid_plates.hpp>
#include <flexpm/kernel/space_lanes/solid_access.hpp>
#include <flexpm/kernel/space_lanes/solid_bodies.hpp>
#include <flexpm/kernel/statics/solid_field.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace flexpm {

namespace {

constexpr double small_strain = 1e-7;  ///< at which stretch and turns are linear, but no round-off

std::vector<int> need_nodes(const SolidState& s, SolidSide side)
{
    std::vector<int> nodes = side_nodes(s, side);
    if (nodes.empty()) {
        refuse("nodes of side " + std::to_string(static_cast<int>(side)), 0.0, "",
            "must be above 0; give a solid that has it");
    }
    return nodes;
}

/// Node on the bottom next to a place; of rigid grains the centre of one that lies there.
int node_near(const SolidState& s, double x, double y)
{
    int nearest = -1;
    double least = 0.0;
    const auto look = [&](int node) {
        const Vector r = space_vector(s.grains.reference, node);
        const double way = (r.x - x) * (r.x - x) + (r.y - y) * (r.y - y);
        if (nearest >= 0 && way >= least) return;
        nearest = node;
        least = way;
    };
    for (std::size_t t = 0; t < s.surface.side.size(); ++t) {
        if (s.surface.side[t] != static_cast<int>(SolidSide::bottom)) continue;
        if (!s.bodies.empty()) {
            look(s.grains.centre(s.surface.grain[t]));
            continue;
        }
        for (int n : s.surface.nodes[t])
            look(n);
    }
    return nearest;
}

bool is_held(const SolidState& s, SolidSide side)
{
    if (find_plate(s, side) >= 0) return true;
    if (!s.bodies.empty()) return false;
    const std::vector<int> nodes = side_nodes(s, side);
    return !nodes.empty() && s.grains.prescribed[s.grains.component(nodes.front(), z_axis)];
}

bool is_held(const SolidState& s)
{
    return is_held(s, SolidSide::bottom) && is_held(s, SolidSide::top);
}

void need_held(const SolidState& s)
{
    if (!is_held(s)) refuse("held ends", 0.0, "", "must be 2; call hold_ends() first");
}

/// Faces of a grain on a side.
struct SideFaces {
    Vector area;    ///< along the normal, outwards [m^2]
    Vector middle;  ///< [m]
};

/// Cosine between a face's normal and an axis from which on it lies across that.
constexpr double steep = 0.5;

/// Those on a side by their grains.
std::map<int, SideFaces> faces_on(const SolidState& s, int side)
{
    std::map<int, SideFaces> faces;
    std::map<int, double> areas;
    for (int t = 0; t < static_cast<int>(s.surface.side.size()); ++t) {
        if (s.surface.side[t] != side) continue;
        const Vector area = area_vector(s, t);
        SideFaces& own = faces[s.surface.grain[t]];
        own.area = own.area + area;
        areas[s.surface.grain[t]] += norm(area);
        for (int n : s.surface.nodes[t])
            own.middle = own.middle + norm(area) / 3.0 * space_vector(s.grains.reference, n);
    }
    for (auto& [grain, own] : faces)
        own.middle = (1.0 / areas[grain]) * own.middle;
    return faces;
}

}  // namespace

void hold_ends(SolidState& s, const EndHold& how)
{
    for (const SolidSide side : { SolidSide::bottom, SolidSide::top })
        need_nodes(s, side);
    if (is_held(s)) refuse("held ends", 2.0, "", "must be 0; the ends are held already");
    for (const SolidSide side : { SolidSide::bottom, SolidSide::top })
        hold_end(s, side, how);
}

void hold_end(SolidState& s, SolidSide side, const EndHold& how)
{
    if (is_held(s, side)) return;
    if (s.bodies.empty() && !how.plates) {
        prescribe(s, need_nodes(s, side), z_axis, 0.0);
    } else {
        add_end_plate(s, side, how.pulled);
    }
}

void hold_against_sliding(SolidState& s)
{
    const std::vector<int> bottom = need_nodes(s, SolidSide::bottom);
    Vector middle;
    double farthest = 0.0;
    for (int n : bottom)
        middle = middle
            + (1.0 / static_cast<double>(bottom.size())) * space_vector(s.grains.reference, n);
    for (int n : bottom)
        farthest = std::max(farthest, s.grains.reference[n] - middle.x);
    const int centre = node_near(s, middle.x, middle.y);
    prescribe(s, { centre }, 0, 0.0);
    prescribe(s, { centre }, 1, 0.0);
    const int other = node_near(s, middle.x + 0.5 * farthest, middle.y);
    if (other != centre) prescribe(s, { other }, 1, 0.0);
}

void hold_side(SolidState& s, int side, int axis)
{
    if (axis < 0 || axis >= s.grains.layout.dimension)
        refuse("hold_side: axis", axis, "", "must be 0, 1 or 2");
    const std::vector<int> nodes = need_nodes(s, static_cast<SolidSide>(side));
    if (s.bodies.empty()) return prescribe(s, nodes, axis, 0.0);
    for (const auto& [grain, faces] : faces_on(s, side)) {
        const double across[] = { faces.area.x, faces.area.y, faces.area.z };
        const int centre = s.grains.centre(grain);
        if (std::fabs(across[axis]) > steep * norm(faces.area)) {
            prescribe(s, { centre }, axis, 0.0);
        } else {
            s.held_faces.push_back(
                { grain, axis, faces.middle - space_vector(s.grains.reference, centre) });
        }
    }
}

void start_ends(SolidState& s, const SolidField& field, double strain, double velocity,
    bool undamped, double dt)
{
    need_held(s);
    start(s, drive_of_top(s), field, strain, velocity, undamped, dt);
}

ElasticConstants constants_between_ends(SolidState s)
{
    hold_ends(s, { true, false });
    s.gravity = {};
    const SolidFrame frame = solid_frame(s, Sense::tension);
    start_ends(s, elastic_field(s), small_strain, 0.0, false, 1.0);
    const AxialObservation found = observe(s, frame);
    return { found.axial_stress / found.axial_strain, found.lateral_strain / found.axial_strain };
}

}  // namespace flexpm
