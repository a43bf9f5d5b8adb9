// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/measure/solid_overlaps.hpp>

#include <flexpm/kernel/space_lanes/tetrahedron_forces.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>

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

/// Grains in the boxes of a lattice, whose edge holds the largest of them.
class Lattice {
public:
    explicit Lattice(const std::vector<Body>& bodies)
    {
        for (const Body& b : bodies)
            edge_ = std::max(edge_, 2.0 * b.radius);
        for (std::size_t g = 0; g < bodies.size(); ++g)
            boxes_[box(bodies[g].centre)].push_back(static_cast<int>(g));
    }

    /// Call visit(grain) for the grains in and about the box of a place.
    template <class Visit> void for_each_near(Vector p, Visit visit) const
    {
        const auto [x, y, z] = box(p);
        for (int i = -1; i <= 1; ++i)
            for (int j = -1; j <= 1; ++j)
                for (int k = -1; k <= 1; ++k) {
                    const auto found = boxes_.find({ x + i, y + j, z + k });
                    if (found == boxes_.end()) continue;
                    for (int g : found->second)
                        visit(g);
                }
    }

private:
    using Box = std::tuple<std::int64_t, std::int64_t, std::int64_t>;
    double edge_ = 0.0;
    std::map<Box, std::vector<int>> boxes_;

    Box box(Vector p) const
    {
        const auto of = [&](double c) { return static_cast<std::int64_t>(std::floor(c / edge_)); };
        return { of(p.x), of(p.y), of(p.z) };
    }
};

}  // namespace

SolidOverlap largest_overlap(const SolidState& s)
{
    const int grains = s.grains.count;
    std::vector<Body> bodies;
    double diameter = 0.0;
    for (int g = 0; g < grains; ++g) {
        bodies.push_back(body_of(s, g));
        diameter += 2.0 * s.grains.radius[g] / grains;
    }
    std::vector<std::set<int>> neighbours(grains);
    for (const auto& [a, b] : s.contacts.pairs)
        neighbours[a].insert(b);
    const Lattice lattice(bodies);
    SolidOverlap result;
    for (int g = 0; g < grains; ++g) {
        const Body& body = bodies[g];
        lattice.for_each_near(body.centre, [&](int other) {
            if (other <= g || neighbours[g].count(other)) return;
            const Body& next = bodies[other];
            if (norm(next.centre - body.centre) >= body.radius + next.radius) return;
            const double depth = std::max(depth_within(body, next), depth_within(next, body));
            if (!(depth > 0.0)) return;
            ++result.pairs;
            if (!(depth > result.depth)) return;
            result.depth = depth;
            result.pair = { g, other };
        });
    }
    result.of_diameter = result.depth / diameter;
    return result;
}

}  // namespace flexpm
