// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Cells of random packings: what they fill, their tetrahedra and the points of their faces.
#include <flexpm/kernel/space/face_triangles.hpp>
#include <flexpm/kernel/space/fan_meshes.hpp>

#include "space/face_moments.hpp"

using namespace flexpm_test;

namespace {

constexpr double diameter = 3e-3;

Solid cube() { return Solid::box(0.0175, 0.0175, 0.0175); }

/// Number of edges below a limit [m].
int short_edges(const Polyhedra& cells, double limit)
{
    std::map<std::pair<int, int>, int> found;
    for (std::size_t f = 0; f < cells.faces.size(); ++f) {
        const auto corners = cells.corners(static_cast<int>(f));
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const auto [u, v] = std::minmax(corners[k], corners[(k + 1) % corners.size()]);
            if (norm(cells.vertices[u] - cells.vertices[v]) < limit) ++found[{ u, v }];
        }
    }
    return static_cast<int>(found.size());
}

}  // namespace

TEST_CASE(
    "cells of packings fill their outline, with positive tetrahedra and exact points", "[space]")
{
    const int packings = cases("FLEXPM_PACKINGS", 50);
    int fallbacks = 0, left = 0, contacts = 0, uncollapsed = 0, grains = 0;
    for (int seed = 1; seed <= packings; ++seed) {
        CAPTURE(seed);
        const Solid solid = seed % 5 == 0 ? Solid::cylinder(0.0175, 0.0223, diameter) : cube();
        const auto spheres = packed_spheres(solid, 200, seed);
        require_filled(polyhedra(spheres, solid, { 0.0, true }), solid);
        const Polyhedra cells = polyhedra(spheres, solid, { 0.1 * diameter, true });
        require_filled(cells, solid);
        REQUIRE(cells.hidden_spheres.empty());

        const FanMeshes meshes = fan_meshes(cells);
        for (int c = 0; c < cells.cells(); ++c) {
            double sum = 0.0, least = 1.0;
            for (auto e = meshes.element_offsets[c]; e < meshes.element_offsets[c + 1]; ++e) {
                sum += meshes.volumes[e];
                least = std::min(least, meshes.volumes[e]);
            }
            REQUIRE(least > 0.0);
            REQUIRE(sum == Approx(cells.volumes[c]).epsilon(1e-11));
        }
        for (int f = 0; f < cells.contacts; ++f) {
            const auto corners = polygon(cells, f);
            for (FacePointRule rule :
                { FacePointRule::corners_and_inner, FacePointRule::three, FacePointRule::four }) {
                const FacePoints points = face_points(corners, rule);
                fallbacks += points.fallback;
                require_exact(corners, points, 2);
            }
        }
        left += cells.short_edges;
        REQUIRE(short_edges(cells, 0.1 * diameter) == cells.short_edges);
        contacts += cells.contacts;
        uncollapsed += cells.uncollapsed_contacts;
        grains += cells.cells();
    }
    const double scale = 1.0 / grains;
    CHECK(scale * uncollapsed == Approx(5.4).epsilon(0.02));
    CHECK(scale * contacts == Approx(5.15).epsilon(0.02));
    CHECK(scale * left < 0.02);
    CHECK(scale * fallbacks < 1e-3);
}

TEST_CASE("the same spheres give the same cells whatever stands beside them in memory", "[space]")
{
    const auto spheres = packed_spheres(cube(), 200, 1);
    const Polyhedra a = polyhedra(spheres, cube(), { 0.1 * diameter, false });
    const Polyhedra b = polyhedra(spheres, cube(), { 0.1 * diameter, false });
    REQUIRE((a.face_vertices == b.face_vertices));
    for (std::size_t v = 0; v < a.vertices.size(); ++v)
        REQUIRE(norm(a.vertices[v] - b.vertices[v]) == 0.0);
}

TEST_CASE("a fan has one tetrahedron for each triangle of the surface", "[space]")
{
    const Solid solid = Solid::box(2.0, 1.0, 1.0);
    const Polyhedra cells =
        polyhedra({ { { 0.5, 0.5, 0.5 }, 0.5 }, { { 1.5, 0.5, 0.5 }, 0.5 } }, solid, {});
    REQUIRE(cells.contacts == 1);
    REQUIRE(cells.faces.size() == 11);
    const FanMeshes meshes = fan_meshes(cells);
    REQUIRE(meshes.elements.size() == 24);
    REQUIRE(meshes.node_vertices.size() == 18);
    for (double volume : meshes.volumes)
        CHECK(volume == Approx(1.0 / 12.0));
}

TEST_CASE("polygons are cut from the corner whose worst triangle is best", "[space]")
{
    // from corner 0 or 2 a triangle would have no area
    const std::vector<Vector> vertices = { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 }, { 1, 2, 0 } };
    const auto triangles = face_triangles(vertices, { 0, 1, 2, 3 });
    REQUIRE(triangles.size() == 2);
    for (const auto& [a, b, c] : triangles)
        CHECK(norm(area_of({ vertices[a], vertices[b], vertices[c] })) == Approx(1.0));
    CHECK(std::acos(sharpest_cosine({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }))
        == Approx(std::atan(std::sqrt(2.0))));
}

TEST_CASE("spheres that cannot have cells are refused by number", "[space]")
{
    const Solid box = Solid::box(1.0, 1.0, 1.0);
    const Sphere middle { { 0.5, 0.5, 0.5 }, 0.2 };
    const auto message = [&](std::vector<Sphere> spheres) {
        return [=] { polyhedra(spheres, box, {}); };
    };
    CHECK_THROWS_WITH(message({})(), Catch::Contains("spheres = 0, must be >= 1"));
    CHECK_THROWS_WITH(message({ middle, { { 0.2, 0.2, 1.0 }, 0.1 } })(),
        Catch::Contains("sphere 1: centre = (0.2, 0.2, 1) m, must lie inside the outline"));
    CHECK_THROWS_WITH(message({ middle, { { 0.5, 0.5, 0.5 + 1e-8 }, 0.1 } })(),
        Catch::Contains(
            "sphere 1: centre = (0.5, 0.5, 0.50000001) m, must not be that of sphere 0"));
    CHECK_THROWS_WITH(message({ middle, { { 0.5, 0.54, 0.5 }, 0.01 } })(),
        Catch::Contains("hidden spheres = 1 (1), must have a cell"));
    CHECK_THROWS_WITH(
        message({ { { 0.5, 0.5, std::nan("") }, 0.1 } })(), Catch::Contains("must be finite"));
    CHECK_THROWS_WITH(
        message({ { { 0.5, 0.5, 0.5 }, -0.1 } })(), Catch::Contains("radius = -0.1 m"));
    CHECK_THROWS_WITH(
        polyhedra({ middle }, box, { -1.0, false }), Catch::Contains("short_edge = -1 m"));
    const Polyhedra dropped =
        polyhedra({ middle, { { 0.5, 0.54, 0.5 }, 0.01 } }, box, { 0.0, true });
    CHECK(dropped.hidden_spheres == std::vector<int> { 1 });
    CHECK(dropped.volumes == std::vector<double> { 1.0 });
}

TEST_CASE("a sphere outside its own cell has its grain's centre at the centroid", "[space]")
{
    const Solid box = Solid::box(1.0, 1.0, 1.0);
    const Polyhedra cells =
        polyhedra({ { { 0.3, 0.5, 0.5 }, 0.5 }, { { 0.6, 0.5, 0.5 }, 0.1 } }, box, {});
    // the radical plane: x = 0.85
    REQUIRE(cells.moved_centres == std::vector<int> { 1 });
    CHECK(cells.centres[1].x == Approx(0.925));
    CHECK(cells.volumes[1] == Approx(0.15));
    CHECK(fan_meshes(cells).volumes.size() == 24);
}

TEST_CASE("a short edge across an edge of the outline stays", "[space]")
{
    const Solid box = Solid::box(1.0, 1.0, 1.0);
    // the radical plane x + y = 0.05 leaves a prism with two edges of 0.07, each between two walls
    const std::vector<Sphere> spheres = { { { 0.01, 0.01, 0.5 }, 0.01 },
        { { 0.5, 0.5, 0.5 }, std::sqrt(0.4509) } };
    const Polyhedra cells = polyhedra(spheres, box, { 0.1, false });
    require_filled(cells, box);
    CHECK(cells.short_edges >= 2);
    CHECK(cells.volumes[0] == Approx(0.5 * 0.05 * 0.05));
}
