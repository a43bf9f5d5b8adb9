// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/measure/solid_overlaps.hpp>

#include <flexpm/kernel/geometry/near_boxes.hpp>
#include <flexpm/kernel/space_lanes/solid_access.hpp>
#include <flexpm/kernel/space_lanes/tetrahedron_forces.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexpm {

namespace {

/// A grain where it is now: its corners, and planes of its outer triangles.
struct Body {
    std::vector<Vector> corners;
    std::vector<Vector> normals;  ///< outwards, of length 1
    std::vector<double> offsets;  ///< dot(normal, p) of a point p on the plane
    Vector centre;
    double radius = 0.0;  ///< of the sphere about the centre that holds all [m]
};

Body body_of(const SolidState& s, int grain)
{
    Body b;
    b.centre = s.grains.position(s.grains.centre(grain));
    for (int n = 0; n < s.grains.vertices_of(grain); ++n) {
        b.corners.push_back(s.grains.position(s.grains.node(grain, n)));
        b.radius = std::max(b.radius, norm(b.corners.back() - b.centre));
    }
    for_each_tetrahedron(
        s, s.grains.block_of(grain), [&](const TetrahedronShape&, std::array<int, 4> nodes) {
            const Vector first = s.grains.position(nodes[1]);
            const Vector twice =
                cross(s.grains.position(nodes[2]) - first, s.grains.position(nodes[3]) - first);
            const double size = norm(twice);
            if (!(size > 0.0)) return;
            b.normals.push_back((1.0 / size) * twice);
            b.offsets.push_back(dot(b.normals.back(), first));
        });
    return b;
}

/// How far the corners of a grain lie within another at most [m]; 0: nowhere.
double depth_within(const Body& of, const Body& in)
{
    double deepest = 0.0;
    for (const Vector& p : of.corners) {
        const Vector from = p - in.centre;
        if (dot(from, from) >= in.radius * in.radius) continue;
        double depth = std::numeric_limits<double>::infinity();
        for (std::size_t f = 0; f < in.normals.size() && depth > deepest; ++f)
            depth = std::min(depth, in.offsets[f] - dot(in.normals[f], p));
        if (std::isfinite(depth)) deepest = std::max(deepest, depth);
    }
    return deepest;
}

AxisBox box_of(const Body& body)
{
    const Vector reach { body.radius, body.radius, body.radius };
    return { body.centre - reach, body.centre + reach };
}

/// Depth that no law resists, of a pair that overlaps: all of it without a contact.
double unresisted(const SolidState& s, const GrainPair& grains, double depth)
{
    const int number = pair_number(s, grains);
    return number < 0 ? depth : std::clamp(s.pairs[number].clearance, 0.0, depth);
}

}  // namespace

SolidOverlap largest_overlap(const SolidState& s)
{
    std::vector<Body> bodies;
    std::vector<AxisBox> boxes;
    for (int g = 0; g < s.grains.count; ++g) {
        bodies.push_back(body_of(s, g));
        boxes.push_back(box_of(bodies.back()));
    }
    const std::vector<GrainPair> together = mated_pairs(s);
    SolidOverlap result;
    for (const GrainPair& pair : meeting_boxes(boxes)) {
        if (std::binary_search(together.begin(), together.end(), pair)) continue;
        const Body &one = bodies[pair[0]], &other = bodies[pair[1]];
        if (norm(other.centre - one.centre) >= one.radius + other.radius) continue;
        const double depth = std::max(depth_within(one, other), depth_within(other, one));
        if (!(depth > 0.0)) continue;
        ++result.pairs;
        result.clearance = std::max(result.clearance, unresisted(s, pair, depth));
        if (!(depth > result.depth)) continue;
        result.depth = depth;
        result.pair = pair;
    }
    const double diameter = mean_diameter(s.grains);
    result.of_diameter = result.depth / diameter;
    result.clearance /= diameter;
    return result;
}

}  // namespace flexpm
