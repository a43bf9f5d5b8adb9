// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Spheres and checks shared by the tests of polyhedral cells.
#pragma once

#include <flexpm/kernel/core/random.hpp>
#include <flexpm/kernel/space/polyhedra.hpp>
#include <flexpm/kernel/space/sphere_insertion.hpp>

#include "support/catch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace flexpm_test {

using namespace flexpm;

/// Number of cases: few, or as many as the night asks for.
inline int cases(const char* variable, int few)
{
    const char* asked = std::getenv(variable);
    return asked != nullptr ? std::atoi(asked) : few;
}

/// A rotation by its rows.
using Rotation = std::array<Vector, 3>;

/// Rotation of a unit quaternion, which is drawn uniformly.
inline Rotation random_rotation(Random& random)
{
    std::array<double, 4> q {};
    double square = 0.0;
    do {
        square = 0.0;
        for (double& c : q) {
            c = 2.0 * random.next() - 1.0;
            square += c * c;
        }
    } while (square > 1.0 || square < 1e-2);
    for (double& c : q)
        c /= std::sqrt(square);
    const auto [w, x, y, z] = q;
    return { { { 1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y) },
        { 2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x) },
        { 2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y) } } };
}

inline Vector turned(const Rotation& r, Vector p)
{
    return { dot(r[0], p), dot(r[1], p), dot(r[2], p) };
}

/// Spheres of a packing: inserted at half their radius, then pushed apart until they overlap
/// little.
inline std::vector<Sphere> packed_spheres(const Solid& solid, int count, std::uint64_t seed)
{
    Random random(seed);
    std::vector<double> radii(count);
    for (double& r : radii)
        r = 1e-3 + 1e-3 * random.next();
    const auto centres = insert_spheres(radii, solid, 0.5, seed);
    std::vector<Sphere> spheres;
    for (int i = 0; i < count; ++i)
        spheres.push_back({ centres[i], radii[i] });
    for (int round = 0; round < 60; ++round) {
        std::vector<Vector> push(count);
        for (int i = 0; i < count; ++i) {
            for (int j = 0; j < i; ++j) {
                const Vector apart = spheres[i].centre - spheres[j].centre;
                const double sum = radii[i] + radii[j], square = dot(apart, apart);
                if (square > sum * sum) continue;
                const double distance = std::sqrt(square);
                const Vector half = (0.25 * (sum - distance) / distance) * apart;
                push[i] = push[i] + half;
                push[j] = push[j] - half;
            }
            for (const Wall& wall : solid.walls) {
                const double gap = wall.offset - dot(wall.normal, spheres[i].centre) - radii[i];
                if (gap < 0.0) push[i] = push[i] + 0.5 * gap * wall.normal;
            }
        }
        for (int i = 0; i < count; ++i)
            spheres[i].centre = spheres[i].centre + push[i];
    }
    return spheres;
}

/// Corners of a face [m].
inline std::vector<Vector> polygon(const Polyhedra& cells, int face)
{
    std::vector<Vector> result;
    for (int v : cells.corners(face))
        result.push_back(cells.vertices[v]);
    return result;
}

/// Area vector of a polygon [m^2].
inline Vector area_of(const std::vector<Vector>& corners)
{
    Vector sum;
    for (std::size_t k = 1; k + 1 < corners.size(); ++k)
        sum = sum + 0.5 * cross(corners[k] - corners[0], corners[k + 1] - corners[0]);
    return sum;
}

/// Cells fill the solid and fit together: each edge of a cell is in two of its faces, once each
/// way; all of the surface lies on the walls; no volume is missing. One check each, as there are
/// many.
inline void require_filled(const Polyhedra& cells, const Solid& solid)
{
    const double sum = std::accumulate(cells.volumes.begin(), cells.volumes.end(), 0.0);
    REQUIRE(std::abs(sum / solid.volume - 1.0) < 1e-12);
    REQUIRE(*std::min_element(cells.volumes.begin(), cells.volumes.end()) > 0.0);
    std::map<std::array<int, 3>, int> edges;  // cell, from, to
    int wrong = 0;
    const double size = norm(solid.high - solid.low);
    for (std::size_t f = 0; f < cells.faces.size(); ++f) {
        const PolyhedronFace& face = cells.faces[f];
        const auto corners = cells.corners(static_cast<int>(f));
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const int u = corners[k], v = corners[(k + 1) % corners.size()];
            wrong += edges[{ face.cell_a, u, v }]++;
            if (face.cell_b >= 0) wrong += edges[{ face.cell_b, v, u }]++;
            if (face.wall < 0) continue;
            const Wall& wall = solid.walls[face.wall];
            wrong += std::abs(dot(wall.normal, cells.vertices[u]) - wall.offset) > 1e-12 * size;
        }
        wrong += (face.cell_b < 0) != (face.wall >= 0)
            || (face.cell_b >= 0 && face.cell_b <= face.cell_a);
    }
    for (const auto& [edge, times] : edges)
        wrong += edges.count({ edge[0], edge[2], edge[1] }) != 1;
    REQUIRE(wrong == 0);
}

}  // namespace flexpm_test
