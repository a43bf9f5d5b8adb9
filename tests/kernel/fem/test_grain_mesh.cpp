// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Meshes of grains: counts, areas, angles, and what happens to awkward cells.
#include "support/disc_samples.hpp"

#include <flexpm/kernel/fem/grain_mesh.hpp>

#include <map>

using namespace flexpm_test;

namespace {

std::vector<Point> regular_polygon(int corners)
{
    std::vector<Point> polygon;
    for (int k = 0; k < corners; ++k)
        polygon.push_back({ std::cos(2.0 * pi * k / corners), std::sin(2.0 * pi * k / corners) });
    return polygon;
}

/// All triangles counter-clockwise, together the polygon; the polygon's edges once, all others
/// twice.
void require_mesh(const GrainMesh& mesh, const std::vector<Point>& polygon)
{
    const int corners = static_cast<int>(polygon.size());
    double area = 0.0, sum = 0.0;
    std::set<std::pair<int, int>> edges;
    for (const Triangle& t : mesh.triangles) {
        const double twice = orientation(mesh.nodes[t[0]], mesh.nodes[t[1]], mesh.nodes[t[2]]);
        REQUIRE(twice > 0.0);
        sum += 0.5 * twice;
        for (int k = 0; k < 3; ++k)
            REQUIRE(edges.insert({ t[k], t[(k + 1) % 3] }).second);
    }
    for (int k = 0; k < corners; ++k) {
        const Point corner = polygon[(mesh.first_vertex + k) % corners];
        REQUIRE(mesh.nodes[k].x == corner.x);
        REQUIRE(mesh.nodes[k].y == corner.y);
        REQUIRE(edges.count({ k, (k + 1) % corners }) == 1);
        REQUIRE(edges.count({ (k + 1) % corners, k }) == 0);
        area += 0.5 * orientation(polygon[0], polygon[k], polygon[(k + 1) % corners]);
    }
    REQUIRE(sum == Approx(area).epsilon(1e-12));
    REQUIRE(edges.size() == 3 * mesh.triangles.size());
    const std::size_t all = (3 * mesh.triangles.size() + corners) / 2;
    REQUIRE(mesh.nodes.size() + mesh.triangles.size() == all + 1);
}

}  // namespace

TEST_CASE("regular polygons take the templates", "[grain_mesh]")
{
    const int v = GENERATE(range(3, 13));
    const auto polygon = regular_polygon(v);
    const GrainMesh fan = make_grain_mesh(polygon, {}, MeshKind::fan);
    const GrainMesh refined = make_grain_mesh(polygon, {}, MeshKind::refined);
    require_mesh(fan, polygon);
    require_mesh(refined, polygon);
    REQUIRE(fan.nodes.size() == static_cast<std::size_t>(v + 1));
    REQUIRE(fan.triangles.size() == static_cast<std::size_t>(v));
    REQUIRE(refined.nodes.size() == static_cast<std::size_t>(2 * v));
    REQUIRE(refined.triangles.size() == static_cast<std::size_t>(3 * v - 2));
    REQUIRE(refined.standard);
    REQUIRE(refined.triangles == mesh_template(v, MeshKind::refined).triangles);
    REQUIRE(refined.smallest_angle >= smallest_template_angle);
    REQUIRE(fan.smallest_angle == Approx(std::min(2.0 * pi / v, 0.5 * pi - pi / v)).epsilon(1e-12));
}

TEST_CASE("inner nodes merge at the shortest edge", "[grain_mesh]")
{
    const std::vector<Point> polygon { { 0, 0 }, { 4, 0 }, { 5, 2 }, { 4.6, 2.6 }, { 2, 4 },
        { -1, 2 } };
    const Point centre { 2, 1.8 };
    const GrainMesh mesh = make_grain_mesh(polygon, centre, MeshKind::refined);
    require_mesh(mesh, polygon);
    REQUIRE(mesh.first_vertex == 3);
    REQUIRE(mesh.nodes[6].x == centre.x);
    REQUIRE(mesh.nodes[6].y == centre.y);
    // half way from the centre to the middle of the edge (5, 2) - (4.6, 2.6)
    REQUIRE(mesh.nodes[7].x == Approx(0.5 * (2.0 + 4.8)));
    REQUIRE(mesh.nodes[7].y == Approx(0.5 * (1.8 + 2.3)));
}

TEST_CASE("a centre that does not see every edge is replaced by the centroid", "[grain_mesh]")
{
    const auto polygon = regular_polygon(6);
    const Point centre = GENERATE(Point { 2.0, 0.1 }, Point { 1.0, 0.0 }, Point { -0.9, 0.8 });
    for (MeshKind kind : { MeshKind::fan, MeshKind::refined }) {
        const GrainMesh mesh = make_grain_mesh(polygon, centre, kind);
        require_mesh(mesh, polygon);
        REQUIRE(mesh.moved_centre);
        REQUIRE(std::abs(mesh.nodes[6].x) < 1e-15);
        REQUIRE(std::abs(mesh.nodes[6].y) < 1e-15);
    }
}

TEST_CASE("awkward cells still get a mesh", "[grain_mesh]")
{
    const std::vector<std::vector<Point>> cells {
        { { 0, 0 }, { 10, 0 }, { 10, 0.3 }, { 0, 0.3 } },
        { { 0, 0 }, { 4, 0 }, { 2, 0.4 } },
        { { 0, 0 }, { 3, 0.4 }, { 6, 0 }, { 3, 1.2 } },
        { { 0, 0 }, { 1, 0 }, { 1.01, 0.01 }, { 1.01, 1 }, { 0.5, 1.8 }, { 0, 1 } },
    };
    for (const auto& polygon : cells)
        for (double x : { 0.2, 0.5, 0.8 }) {
            const Point a = polygon[0], b = polygon[polygon.size() / 2];
            const Point centre { a.x + x * (b.x - a.x), a.y + x * (b.y - a.y) };
            const GrainMesh mesh = make_grain_mesh(polygon, centre, MeshKind::refined);
            require_mesh(mesh, polygon);
            REQUIRE(mesh.smallest_angle == smallest_angle(mesh.nodes, mesh.triangles));
        }
}

TEST_CASE("flips make a triangulation Delaunay", "[grain_mesh]")
{
    // a kite with the long diagonal: the short one has the larger smallest angle
    const std::vector<Point> nodes { { 0, 0 }, { 3, -1 }, { 6, 0 }, { 3, 1 } };
    std::vector<Triangle> triangles { { 0, 1, 2 }, { 0, 2, 3 } };
    flip_edges(nodes, triangles);
    for (const Triangle& t : triangles)
        REQUIRE(
            std::set<int>(t.begin(), t.end()).count(1) + std::count(t.begin(), t.end(), 3) == 2);
    REQUIRE(smallest_angle(nodes, triangles) == Approx(2.0 * std::atan(1.0 / 3.0)));
}

TEST_CASE("a whole specimen obeys the counts", "[grain_mesh]")
{
    const auto discs = random_discs(300, 8);
    const auto t = tessellate(discs, rectangle(1.0, 1.0), { 0.12 * mean_diameter(discs), true });
    std::size_t nodes = 0, triangles = 0, fans = 0;
    const auto meshes = make_grain_meshes(t, discs, MeshKind::refined);
    for (int c = 0; c < t.cells(); ++c) {
        require_mesh(meshes[c], cell_polygon(t, c));
        if (meshes[c].fallback) {
            ++fans;
            continue;
        }
        nodes += meshes[c].nodes.size() - 2 * t.vertices_of(c);
        triangles += meshes[c].triangles.size() - 3 * t.vertices_of(c) + 2;
    }
    REQUIRE(nodes == 0);
    REQUIRE(triangles == 0);
    REQUIRE(fans < 0.05 * t.cells());
}
