// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Given cells: those of a packing come back, and what is no cell is refused by its numbers.
#include <flexpm/kernel/space/own_polyhedra.hpp>

#include "support/sphere_samples.hpp"

using namespace flexpm_test;

namespace {

constexpr double side = 0.0175;

Solid cube() { return Solid::box(side, side, side); }

OwnCells own_of(const Polyhedra& cells)
{
    OwnCells own { cells.vertices, {}, {} };
    for (std::size_t f = 0; f < cells.faces.size(); ++f) {
        const PolyhedronFace& face = cells.faces[f];
        own.faces.push_back({ face.cell_a, face.cell_b, cells.corners(static_cast<int>(f)) });
    }
    for (int c = 0; c < cells.cells(); ++c)
        own.spheres.push_back({ cells.centres[c], std::cbrt(0.75 * cells.volumes[c] / pi) });
    return own;
}

/// Two halves of a cube, below and above; the face between them is the first one.
OwnCells halves()
{
    return own_of(polyhedra({ { { 0.5 * side, 0.5 * side, 0.25 * side }, 0.25 * side },
                                { { 0.5 * side, 0.5 * side, 0.75 * side }, 0.25 * side } },
        cube(), { 0.0, false }));
}

void refused(const OwnCells& own, const std::string& words)
{
    CAPTURE(words);
    REQUIRE_THROWS_WITH(own_polyhedra(own, cube(), 0.0), Catch::Contains(words));
}

}  // namespace

TEST_CASE("cells of spheres come back when they are given as cells", "[space]")
{
    for (int seed = 1; seed <= 5; ++seed) {
        CAPTURE(seed);
        const auto spheres = packed_spheres(cube(), 200, seed);
        const double short_edge = 0.1 * 3e-3;
        const OwnCells own = own_of(polyhedra(spheres, cube(), { 0.0, true }));
        const Polyhedra made = own_polyhedra(own, cube(), short_edge);
        const Polyhedra expected = polyhedra(spheres, cube(), { short_edge, true });
        REQUIRE(made.uncollapsed_contacts == expected.uncollapsed_contacts);
        REQUIRE(made.contacts == expected.contacts);
        REQUIRE(made.short_edges == expected.short_edges);
        REQUIRE(made.face_offsets == expected.face_offsets);
        for (std::size_t f = 0; f < made.faces.size(); ++f) {
            REQUIRE(made.faces[f].cell_a == expected.faces[f].cell_a);
            REQUIRE(made.faces[f].cell_b == expected.faces[f].cell_b);
            REQUIRE(made.faces[f].wall == expected.faces[f].wall);
        }
        for (int c = 0; c < made.cells(); ++c)
            REQUIRE(made.volumes[c] == Approx(expected.volumes[c]).epsilon(1e-12));
    }
}

TEST_CASE("cells that are none are refused by cell and face", "[space]")
{
    const OwnCells good = halves();
    REQUIRE(own_polyhedra(good, cube(), 0.0).contacts == 1);
    OwnCells bad = good;
    bad.faces[0].corners[1] = 99;
    refused(bad, "face 1: corners = 4, must be three or more of 12 vertices");
    bad = good;
    bad.faces[0].second = 2;
    refused(bad, "face 1: cells = 0 and 2, must be two of 2");
    bad = good;
    bad.vertices[3].x = std::nan("");
    refused(bad, "vertex 4 = ");
    bad = good;
    bad.faces.pop_back();
    refused(bad, "must be one of two faces of the cell");
    bad = good;
    std::reverse(bad.faces[0].corners.begin(), bad.faces[0].corners.end());
    refused(bad, "cell 1, face ");
    bad = good;
    bad.faces.push_back(bad.faces[0]);
    refused(bad, "face 12: cell beyond it = 2, is that of face 1");
    bad = good;
    bad.spheres[1].centre.z = 0.4 * side;
    refused(bad, "cell 2: centre = ");
    bad = good;
    bad.spheres.push_back(bad.spheres[0]);
    refused(bad, "cell 3: volume = 0 m^3, must be above 0");
    bad = good;
    bad.spheres[0].radius = 0.0;
    refused(bad, "cell 1: radius = 0 m");
    bad = good;
    for (int v : good.faces[0].corners)
        if (good.vertices[v].x > 0.0 && good.vertices[v].y > 0.0) bad.vertices[v].z *= 1.1;
    refused(bad, "cell 1, face 1: corners off its plane by");
}

TEST_CASE("pores are taken out, and their walls are free", "[space]")
{
    const auto spheres = packed_spheres(cube(), 60, 6);
    const Polyhedra all = polyhedra(spheres, cube(), { 0.0, false });
    OwnCells own = own_of(all);
    own.pores = { 7, 20 };
    const Polyhedra made = own_polyhedra(own, cube(), 3e-4);
    REQUIRE(made.cells() == 58);
    REQUIRE(made.sphere_of_cell.back() == 57);
    REQUIRE(norm(made.centres[7] - all.centres[8]) == 0.0);
    // flanks close each cell: its area vectors add up to 0
    std::vector<Vector> sums(made.cells());
    const auto walls = static_cast<int>(cube().walls.size());
    double flanks = 0.0;
    for (std::size_t f = 0; f < made.faces.size(); ++f) {
        const PolyhedronFace& face = made.faces[f];
        const Vector area = area_of(polygon(made, static_cast<int>(f)));
        sums[face.cell_a] = sums[face.cell_a] + area;
        if (face.cell_b >= 0) sums[face.cell_b] = sums[face.cell_b] - area;
        REQUIRE((face.cell_b >= 0) == (face.wall < 0));
        if (face.wall == walls) flanks += norm(area);
    }
    for (const Vector& sum : sums)
        REQUIRE(norm(sum) < 1e-15);
    double expected = 0.0;
    for (std::size_t f = 0; f < all.faces.size(); ++f) {
        const PolyhedronFace& face = all.faces[f];
        const auto is_pore = [](int cell) { return cell == 7 || cell == 20; };
        if (face.cell_b >= 0 && is_pore(face.cell_a) != is_pore(face.cell_b))
            expected += norm(area_of(polygon(all, static_cast<int>(f))));
    }
    REQUIRE(flanks == Approx(expected).epsilon(0.05));  // but for short edges
    for (const std::vector<int>& pores : { std::vector<int> { 60 }, { 5, 5 }, { 9, 3 } }) {
        own.pores = pores;
        REQUIRE_THROWS_WITH(
            own_polyhedra(own, cube(), 0.0), Catch::Contains("own_polyhedra: pore"));
    }
}
