// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Contacts and areas against the radical cells of voro++, which cuts each cell by itself.
#include "support/sphere_samples.hpp"

#include <voro++/voro++.hh>

using namespace flexpm_test;

namespace {

using Areas = std::map<std::pair<int, int>, double>;  // cells a < b, or cell and -1 for all walls

Areas own_areas(const std::vector<Sphere>& spheres, const Solid& solid)
{
    const Polyhedra cells = polyhedra(spheres, solid, {});
    Areas areas;
    for (std::size_t f = 0; f < cells.faces.size(); ++f) {
        const auto& [a, b, wall] = cells.faces[f];
        areas[{ a, b }] += norm(area_of(polygon(cells, static_cast<int>(f))));
    }
    return areas;
}

Areas radical_areas(const std::vector<Sphere>& spheres, const Solid& solid)
{
    voro::container_poly box(solid.low.x, solid.high.x, solid.low.y, solid.high.y, solid.low.z,
        solid.high.z, 5, 5, 5, false, false, false, 8);
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        const auto& [c, r] = spheres[i];
        box.put(static_cast<int>(i), c.x, c.y, c.z, r);
    }
    Areas areas;
    voro::c_loop_all loop(box);
    voro::voronoicell_neighbor cell;
    std::vector<int> neighbours;
    std::vector<double> of_faces;
    if (loop.start()) do {
            if (!box.compute_cell(cell, loop)) continue;
            cell.neighbors(neighbours);
            cell.face_areas(of_faces);
            for (std::size_t k = 0; k < neighbours.size(); ++k) {
                const int a = loop.pid(), b = std::max(neighbours[k], -1);
                if (b < 0 || a < b) areas[{ a, b }] += of_faces[k];
            }
        } while (loop.inc());
    return areas;
}

}  // namespace

TEST_CASE("contacts and areas are those of voro++'s radical cells", "[space]")
{
    const Solid solid = Solid::box(17.5, 17.5, 17.5);
    for (int seed = 1; seed <= cases("FLEXPM_PACKINGS", 50) / 5; ++seed) {
        CAPTURE(seed);
        const Solid small = Solid::box(0.0175, 0.0175, 0.0175);
        auto spheres = packed_spheres(small, 200, seed);
        for (auto& [centre, radius] : spheres) {  // in millimetres: voro++ has absolute tolerances
            centre = 1e3 * centre;
            radius *= 1e3;
        }
        constexpr double square = 9.0;  // of the mean diameter
        const Areas own = own_areas(spheres, solid), other = radical_areas(spheres, solid);
        int compared = 0;
        for (const auto& [pair, area] : other) {
            if (area < 1e-6 * square) continue;
            ++compared;
            REQUIRE(own.count(pair) == 1);
            REQUIRE(std::abs(own.at(pair) - area) < 1e-9 * square);
        }
        for (const auto& [pair, area] : own)
            if (area > 1e-6 * square) REQUIRE(other.count(pair) == 1);
        REQUIRE(compared > 1000);
    }
}
