// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/solid_beam.hpp>

#include <flexpm/kernel/assembly/solid_plan.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/parts/node_sets.hpp>
#include <flexpm/kernel/parts/solid_plates.hpp>
#include <flexpm/kernel/space_lanes/solid_access.hpp>
#include <flexpm/kernel/statics/solid_loading.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace flexpm {

namespace {

/// Least cosine between a plate's normal and that of a triangle, inwards, that it may touch.
constexpr double facing = 0.5;

/// Where a line along y crosses a triangle of the surface.
struct Crossing {
    int triangle;
    std::array<double, 3> shares;  ///< of the corners in its middle
    double length;                 ///< [m]
    double z;                      ///< of its middle [m]
};

/// A corner on the line counts to its left: an edge on it is crossed by one of two triangles.
bool crosses(const SolidState& s, int triangle, double x, Crossing& found)
{
    std::array<Vector, 3> r;
    for (int k = 0; k < 3; ++k)
        r[k] = space_vector(s.grains.reference, s.surface.nodes[triangle][k]);
    const auto right = [&](int k) { return r[k].x > x; };
    const int count = right(0) + right(1) + right(2);
    if (count == 0 || count == 3) return false;
    int alone = 0;  // corner on a side of its own
    while (right(alone) != (count == 1))
        ++alone;
    found = { triangle, {}, 0.0, 0.0 };
    std::array<Vector, 2> ends;
    for (int k = 0; k < 2; ++k) {
        const int other = (alone + k + 1) % 3;
        const double part = (x - r[alone].x) / (r[other].x - r[alone].x);
        found.shares[alone] += 0.5 * (1.0 - part);
        found.shares[other] += 0.5 * part;
        ends[k] = r[alone] + part * (r[other] - r[alone]);
    }
    found.length = norm(ends[1] - ends[0]);
    found.z = 0.5 * (ends[0].z + ends[1].z);
    return found.length > 0.0;
}

/// Crossings of a line with triangles that face a normal, no further than `off` from the place.
std::vector<Crossing> crossings(const SolidState& s, double x, double z, Vector inwards, double off)
{
    std::vector<Crossing> found;
    Crossing one {};
    for (int t = 0; t < static_cast<int>(s.surface.grain.size()); ++t) {
        if (!crosses(s, t, x, one) || !(std::fabs(one.z - z) <= off)) continue;
        const Vector outwards = area_vector(s, t);
        if (-dot(inwards, outwards) > facing * norm(outwards)) found.push_back(one);
    }
    return found;
}

/// Mean way along x of the bottom on a line.
double mean_way(const SolidState& s, double x, double off, const Array<double>& moved)
{
    const double bottom = end_place(s, SolidSide::bottom);
    double sum = 0.0, length = 0.0;
    for (const Crossing& one : crossings(s, x, bottom, { 0.0, 0.0, 1.0 }, off)) {
        for (int k = 0; k < 3; ++k)
            sum += one.length * one.shares[k] * moved[s.surface.nodes[one.triangle][k]];
        length += one.length;
    }
    return length > 0.0 ? sum / length : 0.0;
}

Plate plate_along(const SolidState& s, SolidSide side, const BearingLine& line)
{
    check_positive("width of a line plate", line.width, "m");
    check_finite("place of a line plate", line.x + line.z, "m");
    if (!is_end(side)) {
        refuse("add_line_plate: side", static_cast<int>(side), "",
            "must be 0, the bottom, or 2, the top");
    }
    Plate p = plain_plate(s, side);
    p.position = { line.x, 0.0, line.z };
    const std::vector<Crossing> found = crossings(s, line.x, line.z, p.normal, line.width);
    if (found.empty()) {
        refuse("add_line_plate: triangles at x = " + number(line.x) + " m, z = " + number(line.z)
                + " m",
            0.0, "", "must be > 0; place it on the specimen");
    }
    double nearest = std::numeric_limits<double>::infinity();
    for (const Crossing& one : found)
        nearest = std::min(nearest, p.normal.z * one.z);
    for (const Crossing& one : found) {
        PlatePoint point;
        point.facet = one.triangle;
        point.weights = one.shares;
        point.area = one.length * line.width;
        point.normal = p.normal;
        point.gap = point.opening = p.normal.z * one.z - nearest;
        p.points.push_back(point);
    }
    centre_position(s, p);
    if (line.pinned) roughen(p, no_sliding);
    return p;
}

}  // namespace

int add_line_plate(SolidState& s, SolidSide side, const BearingLine& line)
{
    const Plate plate = plate_along(s, side, line);
    require_apart(s, plate);
    return add_plate(s, plate);
}

int find_line_plate(const SolidState& s, SolidSide side, const BearingLine& line)
{
    return find_alike(s.plates, plate_along(s, side, line));
}

double mouth_opening(const SolidState& s, const Mouth& mouth)
{
    return mouth_opening(s, mouth, s.grains.displacement);
}

double mouth_opening(const SolidState& s, const Mouth& mouth, const Array<double>& moved)
{
    return mean_way(s, mouth.middle + mouth.reach, mouth.reach, moved)
        - mean_way(s, mouth.middle - mouth.reach, mouth.reach, moved);
}

}  // namespace flexpm
