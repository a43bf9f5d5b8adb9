// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Checks of joints, and the limits of pieces.
#include <flexpm/kernel/space/joint_planes.hpp>

#include <flexpm/kernel/space/hole_cuts.hpp>
#include <flexpm/kernel/space/polyhedra.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace flexpm {
namespace {

/// Depth over the mean diameter, and volume over the mean one, of the least piece that a cut
/// leaves: as slivers of the plane, deviation D33.
constexpr double least_depth = 0.15, least_volume = 0.02;
/// Cosine of 5 degrees, the least angle between a joint and a face of a piece.
constexpr double largest_cosine = 0.99619469809174555;
/// Distance over the size of a polygon up to which its corners are in its plane, and convex.
constexpr double off_plane = 1e-6;
/// Distance of the length of a normal from 1.
constexpr double round_off = 1e-9;

std::string named(std::size_t joint) { return "joint plane " + std::to_string(joint); }

/// Check a joint, and make its corners counter-clockwise about its normal.
JointPlane checked(JointPlane joint, const std::string& name)
{
    if (!is_finite(joint.normal) || !(std::fabs(norm(joint.normal) - 1.0) <= round_off))
        refuse(name + ": normal", place(joint.normal), "must have the length 1; correct it");
    check_finite(name + ": offset", joint.offset, "m");
    auto& corners = joint.corners;
    if (corners.empty()) return joint;
    if (corners.size() < 3)
        refuse(name + ": corners", static_cast<double>(corners.size()), "",
            "must be three or more; give a polygon");
    Vector twice;
    double size = 0.0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        if (!is_finite(corners[k]))
            refuse(name + ": corner", place(corners[k]), "must be finite; correct it");
        const Vector next = corners[(k + 1) % corners.size()];
        size = std::max(size, norm(next - corners[0]));
        twice = twice + cross(corners[k] - corners[0], next - corners[0]);
    }
    if (!(norm(twice) > off_plane * size * size))
        refuse(name + ": area", 0.5 * norm(twice), "m^2", "must be above 0; correct its corners");
    if (dot(twice, joint.normal) < 0.0) std::reverse(corners.begin(), corners.end());
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const double off = std::fabs(dot(joint.normal, corners[k]) - joint.offset);
        if (!(off <= off_plane * size))
            refuse(name + ": distance of a corner from its plane", off, "m",
                "must be <= " + ::flexpm::number(off_plane * size) + " m; correct the corners");
    }
    // corners on a straight edge are allowed, and make no half-space; a repeated one is left out
    std::vector<Vector> kept;
    for (const Vector& corner : corners)
        if (kept.empty() || norm(corner - kept.back()) > off_plane * size) kept.push_back(corner);
    while (kept.size() > 1 && norm(kept.front() - kept.back()) <= off_plane * size)
        kept.pop_back();
    corners = kept;
    for (const HalfSpace& half : region_between(corners, joint.normal))
        for (const Vector& corner : corners) {
            const double out = dot(half.normal, corner) - half.offset;
            if (out > off_plane * size)
                refuse(name + ": corner beyond an edge by", out, "m",
                    "must be convex; divide the polygon");
        }
    return joint;
}

/// Square in a plane that reaches far beyond a solid.
std::vector<Vector> square_across(const JointPlane& joint, const Solid& solid)
{
    const Vector middle = 0.5 * (solid.low + solid.high), n = joint.normal;
    const Vector on = middle + (joint.offset - dot(n, middle)) * n;
    Vector u = cross(n, std::fabs(n.x) < 0.5 ? Vector { 1, 0, 0 } : Vector { 0, 1, 0 });
    u = (norm(solid.high - solid.low) / norm(u)) * u;
    const Vector v = cross(n, u);
    return { on - u - v, on + u - v, on + u + v, on - u + v };
}

/// Note the planes of all walls: those of the solid, of notches, of joints and of holes.
void set_planes(CellComplex& complex, const Solid& solid, const std::vector<JointPlane>& joints,
    const std::vector<NotchPlane>& notches, const std::vector<Hole>& holes)
{
    if (joints.empty() && holes.empty()) return;
    for (const Wall& wall : solid.walls)
        complex.planes.push_back({ wall.normal, wall.offset });
    for (const NotchPlane& notch : notches)
        complex.planes.push_back({ { 1.0, 0.0, 0.0 }, notch.x });
    complex.first_joint = static_cast<int>(complex.planes.size());
    for (const JointPlane& joint : joints)
        complex.planes.push_back({ joint.normal, joint.offset });
    for (const Hole& hole : holes)
        for (const JointPlane& facet : hole)
            complex.planes.push_back({ facet.normal, facet.offset });
}

}  // namespace

double area_within(const JointPlane& joint, const Solid& solid)
{
    const double size = norm(solid.high - solid.low);
    std::vector<HalfSpace> walls;
    for (const Wall& wall : solid.walls) {
        const double sense = dot(wall.normal, joint.normal);
        const bool is_on_wall = 1.0 - std::fabs(sense) <= round_off
            && std::fabs(sense * joint.offset - wall.offset) <= round_off * size;
        if (is_on_wall) return 0.0;
        walls.push_back({ wall.normal, wall.offset });
    }
    return area_of_polygon(
        part_within(joint.corners.empty() ? square_across(joint, solid) : joint.corners, walls));
}

int first_hole_wall(const Solid& solid, const std::vector<NotchPlane>& notches)
{
    // pores have the wall of the first notch
    return static_cast<int>(solid.walls.size() + std::max<std::size_t>(1, notches.size()));
}

CutCells cut_cells(CellComplex& complex, const Solid& solid, double diameter,
    const std::vector<JointPlane>& joints, const std::vector<NotchPlane>& notches,
    const std::vector<Hole>& holes)
{
    const int walls = complex.flanks = static_cast<int>(solid.walls.size());
    CutCells found;
    if (joints.empty() && notches.empty() && holes.empty()) return found;
    const double close = zero_edge * diameter;
    const double volume = least_volume * solid.volume / static_cast<double>(complex.cells);
    set_planes(complex, solid, joints, notches, holes);
    CellCutter cutter(complex, { close, least_depth * diameter, volume, largest_cosine });
    for (std::size_t i = 0; i < joints.size(); ++i) {
        const JointPlane joint = checked(joints[i], named(i));
        const auto number = static_cast<int>(i);
        PlaneCut cut { joint.normal, joint.offset };
        cut.region = region_between(joint.corners, joint.normal);
        cut.wall = walls + static_cast<int>(notches.size()) + number;
        cut.joint = number;
        found.joints.push_back({ area_within(joint, solid), cutter.cut_by_plane(cut) });
    }
    const auto first_facet = static_cast<int>(joints.size());
    int facets = first_facet;
    for (std::size_t i = 0; i < holes.size(); ++i) {
        HoleCut hole { {}, {}, first_hole_wall(solid, notches) + static_cast<int>(i) };
        for (const JointPlane& given : holes[i]) {
            const JointPlane facet = checked(given, "facet of hole " + std::to_string(i));
            PlaneCut cut { facet.normal, facet.offset };
            cut.region = region_between(facet.corners, facet.normal);
            cut.wall = complex.first_joint + facets;
            cut.joint = facets++;
            hole.facets.push_back(cut);
            hole.polygons.push_back(facet.corners);
        }
        std::vector<HalfSpace> halves;
        for (const PlaneCut& facet : hole.facets)
            halves.push_back({ facet.normal, facet.offset });
        for (PlaneCut& facet : hole.facets)
            facet.hole = halves;
        found.holes.push_back(cut_hole(complex, cutter, hole, close, found.gone));
    }
    if (!holes.empty()) finish_holes(complex, first_facet);
    std::sort(found.gone.begin(), found.gone.end());
    if (static_cast<int>(found.gone.size()) == complex.cells)
        refuse("holes: cells left", 0.0, "", "must be >= 1; make the holes smaller");
    for (std::size_t i = 0; i < notches.size(); ++i) {
        const NotchPlane& notch = notches[i];
        check_finite("place of a notch", notch.x + notch.front, "m");
        const double up = notch.from_above ? -1.0 : 1.0;
        PlaneCut cut { { 1.0, 0.0, 0.0 }, notch.x, { { { 0.0, 0.0, up }, up * notch.front } } };
        cut.wall = walls + static_cast<int>(i);
        cut.open = true;
        cutter.cut_by_plane(cut);
    }
    merge_close_vertices(complex, close);
    found.sources = cutter.sources();
    return found;
}

}  // namespace flexpm
