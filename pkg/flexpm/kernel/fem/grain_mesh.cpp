// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Choice between the template at each start, flipped edges and a fan, by the smallest
/// angle.
#include <flexpm/kernel/fem/grain_mesh.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/geometry/disc_checks.hpp>
#include <flexpm/kernel/geometry/polygon.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace flexpm {
namespace {

/// Smallest angle of one triangle [rad]; negative unless counter-clockwise.
double triangle_angle(Point a, Point b, Point c)
{
    const Point corner[3] = { a, b, c };
    double smallest = 4.0;
    for (int k = 0; k < 3; ++k) {
        const Point o = corner[k], p = corner[(k + 1) % 3], q = corner[(k + 2) % 3];
        const Point u = p - o, v = q - o;
        smallest = std::min(smallest, std::atan2(cross(u, v), dot(u, v)));
    }
    return smallest > 0.0 ? smallest : -1.0;
}

double angle_of(const std::vector<Point>& nodes, const Triangle& t)
{
    return triangle_angle(nodes[t[0]], nodes[t[1]], nodes[t[2]]);
}

/// Edges of the polygon by their start, shortest first.
std::vector<int> edges_by_length(const std::vector<Point>& polygon)
{
    const int v = static_cast<int>(polygon.size());
    std::vector<double> length(v);
    for (int k = 0; k < v; ++k) {
        length[k] = norm(polygon[(k + 1) % v] - polygon[k]);
    }
    std::vector<int> order(v);
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(
        order.begin(), order.end(), [&](int i, int j) { return length[i] < length[j]; });
    return order;
}

GrainMesh standard_mesh(const std::vector<Point>& polygon, Point centre, MeshKind kind, int first)
{
    GrainMesh mesh;
    mesh.first_vertex = first;
    std::vector<Point> corners = polygon;
    std::rotate(corners.begin(), corners.begin() + first, corners.end());
    mesh.nodes = template_nodes(corners, centre, kind);
    mesh.triangles = mesh_template(static_cast<int>(polygon.size()), kind).triangles;
    mesh.smallest_angle = smallest_angle(mesh.nodes, mesh.triangles);
    return mesh;
}

/// The template that starts behind the shortest edge, or the best one if that is too flat.
GrainMesh best_standard_mesh(const std::vector<Point>& polygon, Point centre)
{
    const int v = static_cast<int>(polygon.size());
    GrainMesh best;
    best.smallest_angle = -2.0;
    for (int edge : edges_by_length(polygon)) {
        GrainMesh mesh = standard_mesh(polygon, centre, MeshKind::refined, (edge + 1) % v);
        if (mesh.smallest_angle > best.smallest_angle) best = std::move(mesh);
        if (best.smallest_angle >= smallest_template_angle) break;
    }
    return best;
}

GrainMesh refined_mesh(const std::vector<Point>& polygon, Point centre)
{
    GrainMesh mesh = best_standard_mesh(polygon, centre);
    if (mesh.smallest_angle >= smallest_template_angle) return mesh;
    GrainMesh flipped = mesh;
    flip_edges(flipped.nodes, flipped.triangles);
    flipped.smallest_angle = smallest_angle(flipped.nodes, flipped.triangles);
    if (flipped.smallest_angle > mesh.smallest_angle) {
        flipped.standard = false;
        mesh = std::move(flipped);
    }
    if (mesh.smallest_angle > 0.0) return mesh;
    mesh = standard_mesh(polygon, centre, MeshKind::fan, 0);
    mesh.fallback = true;
    return mesh;
}

/// Triangle and corner number opposite to each directed edge.
using EdgeMap = std::map<std::pair<int, int>, std::pair<int, int>>;

EdgeMap edge_map(const std::vector<Triangle>& triangles)
{
    EdgeMap edges;
    for (int t = 0; t < static_cast<int>(triangles.size()); ++t)
        for (int k = 0; k < 3; ++k)
            edges[{ triangles[t][k], triangles[t][(k + 1) % 3] }] = { t, (k + 2) % 3 };
    return edges;
}

/// Flip the first edge whose flip raises the smaller angle; false if there is none.
bool flip_one(const std::vector<Point>& nodes, std::vector<Triangle>& triangles)
{
    const EdgeMap edges = edge_map(triangles);
    for (const auto& [edge, here] : edges) {
        const auto [a, b] = edge;
        const auto other = edges.find({ b, a });
        if (a > b || other == edges.end()) continue;
        Triangle& t = triangles[here.first];
        Triangle& u = triangles[other->second.first];
        const int p = t[here.second], q = u[other->second.second];
        if (edges.count({ p, q }) > 0 || edges.count({ q, p }) > 0) continue;
        const Triangle t_new { p, a, q }, u_new { p, q, b };
        const double now = std::min(angle_of(nodes, t), angle_of(nodes, u));
        const double then = std::min(angle_of(nodes, t_new), angle_of(nodes, u_new));
        if (then > now + 1e-9) {
            t = t_new;
            u = u_new;
            return true;
        }
    }
    return false;
}

}  // namespace

double smallest_angle(const std::vector<Point>& nodes, const std::vector<Triangle>& triangles)
{
    double smallest = 4.0;
    for (const Triangle& t : triangles)
        smallest = std::min(smallest, angle_of(nodes, t));
    return smallest;
}

void flip_edges(const std::vector<Point>& nodes, std::vector<Triangle>& triangles)
{
    // Each flip raises one of finitely many angles, so this ends; the bound is for round-off.
    const std::size_t most = triangles.size() * triangles.size();
    for (std::size_t k = 0; k < most && flip_one(nodes, triangles); ++k) { }
}

GrainMesh make_grain_mesh(const std::vector<Point>& polygon, Point centre, MeshKind kind)
{
    const PolygonShape shape = polygon_shape(polygon);
    // A centre closer to an edge's line than round-off would give a triangle without area.
    const bool seen = is_star_shaped(polygon, centre, 1e-9 * shape.area);
    if (!(shape.area > 0.0) || !(seen || is_star_shaped(polygon, shape.centroid, 0.0))) {
        refuse("make_grain_mesh: polygon area", shape.area, "m^2",
            "must be positive and the polygon star-shaped about its centre or centroid; correct "
            "the cell");
    }
    const Point inner = seen ? centre : shape.centroid;
    GrainMesh mesh = kind == MeshKind::fan ? standard_mesh(polygon, inner, MeshKind::fan, 0)
                                           : refined_mesh(polygon, inner);
    mesh.moved_centre = !seen;
    return mesh;
}

std::vector<GrainMesh> make_grain_meshes(
    const Tessellation& t, const std::vector<Disc>& discs, MeshKind kind)
{
    require_disc_of_each_cell(t, discs);
    std::vector<GrainMesh> meshes;
    for (int cell = 0; cell < t.cells(); ++cell)
        meshes.push_back(
            make_grain_mesh(cell_polygon(t, cell), discs[t.disc_of_cell[cell]].centre, kind));
    return meshes;
}

}  // namespace flexpm
