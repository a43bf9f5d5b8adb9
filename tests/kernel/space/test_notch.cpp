// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  A notch across a packing: closed cells, no volume lost, flanks in its plane, a front that
/// is straight to half a cell, and nothing that joins its sides below.
#include "space/closed_cells.hpp"

#include <flexpm/kernel/space/fan_meshes.hpp>

#include <set>

using namespace flexpm_test;

namespace {

constexpr double side = 3e-3;  ///< of a grain, roughly [m]
const Solid solid = Solid::box(8.0 * side, 3.0 * side, 5.0 * side);
constexpr NotchPlane half { 4.0 * side, 2.5 * side };

Polyhedra notched(std::uint64_t seed, double short_edge = 0.1 * side)
{
    PolyhedraOptions options { short_edge, false };
    options.notches = { half };
    return polyhedra(packed_spheres(solid, 200, seed), solid, options);
}

/// Area vectors of the flanks: of cells to the left and to the right.
struct Flanks {
    Vector left, right;
    double off = 0.0;  ///< largest distance of a corner from the plane
};

Flanks flanks(const Polyhedra& cells, const Solid& of, double x, int notch = 0)
{
    Flanks found;
    for (std::size_t f = 0; f < cells.faces.size(); ++f) {
        if (cells.faces[f].wall != static_cast<int>(of.walls.size()) + notch) continue;
        const auto corners = polygon(cells, static_cast<int>(f));
        const Vector area = area_of(corners);
        (area.x > 0.0 ? found.left : found.right) =
            (area.x > 0.0 ? found.left : found.right) + area;
        for (const Vector& p : corners)
            found.off = std::max(found.off, std::abs(p.x - x));
    }
    return found;
}

double volume(const Polyhedra& cells)
{
    return std::accumulate(cells.volumes.begin(), cells.volumes.end(), 0.0);
}

}  // namespace

TEST_CASE("Cells about a notch are closed and fill the solid", "[space]")
{
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const Polyhedra cells = notched(seed);
        CHECK(std::abs(volume(cells) / solid.volume - 1.0) < 1e-12);
        CHECK(*std::min_element(cells.volumes.begin(), cells.volumes.end()) > 0.0);
        CHECK(loose_edges(cells) == 0);
        CHECK_NOTHROW(fan_meshes(cells));
        const std::set<int> whole(cells.sphere_of_cell.begin(), cells.sphere_of_cell.end());
        CHECK(whole.size() == 200);
        CHECK(cells.cells() > 205);  // some have been cut
    }
}

TEST_CASE("The flanks of a notch face each other, and its depth is that asked for", "[space]")
{
    const double depth = half.front * (solid.high.y - solid.low.y);
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        for (const double short_edge : { 0.0, 0.1 * side }) {
            const Polyhedra cells = notched(seed, short_edge);
            const Flanks found = flanks(cells, solid, half.x);
            CHECK(norm(found.left + found.right) < 1e-12 * depth);
            CHECK(found.left.x == Approx(depth).epsilon(0.12));
            // cells that stay whole are passed nearby
            CHECK(found.off < 0.4 * side);
        }
    }
}

TEST_CASE("No contact joins the sides of a notch well below its front", "[space]")
{
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const Polyhedra cells = notched(seed);
        int joined = 0, above = 0;
        for (int f = 0; f < cells.contacts; ++f) {
            const auto& face = cells.faces[f];
            const Vector a = cells.centres[face.cell_a], b = cells.centres[face.cell_b];
            if ((a.x - half.x) * (b.x - half.x) >= 0.0) continue;
            (std::max(a.z, b.z) < half.front - side ? joined : above) += 1;
        }
        CHECK(joined == 0);
        CHECK(above > 0);
    }
}

TEST_CASE("A notch between the cells of a lattice cuts none and is their faces", "[space]")
{
    std::vector<Sphere> spheres;
    for (int z = 0; z < 4; ++z)
        for (int y = 0; y < 2; ++y)
            for (int x = 0; x < 6; ++x)
                spheres.push_back(
                    { { side * (x + 0.5), side * (y + 0.5), side * (z + 0.5) }, 0.5 * side });
    const Solid brick = Solid::box(6.0 * side, 2.0 * side, 4.0 * side);
    PolyhedraOptions options { 0.1 * side, false };
    const int before = polyhedra(spheres, brick, options).contacts;
    options.notches = { { 3.0 * side, 2.0 * side } };
    const Polyhedra cells = polyhedra(spheres, brick, options);
    CHECK(cells.cells() == 48);
    CHECK(cells.contacts == before - 4);
    const Flanks found = flanks(cells, brick, 3.0 * side);
    CHECK(found.left.x == Approx(4.0 * side * side));
    CHECK(found.off < 1e-12 * side);
    options.notches = { { 2.5 * side, 2.0 * side } };  // through the middle of cells
    const Polyhedra cut = polyhedra(spheres, brick, options);
    CHECK(cut.cells() == 52);
    CHECK(flanks(cut, brick, 2.5 * side).left.x == Approx(4.0 * side * side));
    CHECK(loose_edges(cut) == 0);
}

TEST_CASE("Notches from below and from above in two planes leave cells closed", "[space]")
{
    const double height = solid.high.z, depth = 1.2 * side;
    PolyhedraOptions options { 0.1 * side, false };
    for (const double x : { 2.5 * side, 5.5 * side })
        for (const bool above : { false, true })
            options.notches.push_back({ x, above ? height - depth : depth, above });
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const Polyhedra cells = polyhedra(packed_spheres(solid, 200, seed), solid, options);
        CHECK(std::abs(volume(cells) / solid.volume - 1.0) < 1e-12);
        CHECK(loose_edges(cells) == 0);
        CHECK_NOTHROW(fan_meshes(cells));
        for (int i = 0; i < 4; ++i) {
            const Flanks found = flanks(cells, solid, options.notches[i].x, i);
            CHECK(norm(found.left + found.right) < 1e-12 * depth);
            CHECK(found.left.x == Approx(depth * solid.high.y).epsilon(0.25));
        }
        const std::set<int> whole(cells.sphere_of_cell.begin(), cells.sphere_of_cell.end());
        CHECK(whole.size() == 200);
    }
    // from above it is the mirror image of one from below
    std::vector<Sphere> spheres = packed_spheres(solid, 200, 1), mirrored = spheres;
    for (Sphere& s : mirrored)
        s.centre.z = height - s.centre.z;
    options = { 0.0, false, { half } };
    const Polyhedra below = polyhedra(spheres, solid, options);
    options.notches = { { half.x, height - half.front, true } };
    const Polyhedra above = polyhedra(mirrored, solid, options);
    REQUIRE(above.cells() == below.cells());
    for (int c = 0; c < below.cells(); ++c)
        CHECK(above.volumes[c] == Approx(below.volumes[c]).epsilon(1e-9));
}
