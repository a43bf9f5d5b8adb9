// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Spheres of the same cells.
#include <flexpm/kernel/space/weighted_cells.hpp>

#include <flexpm/kernel/space/polyhedra.hpp>
#include <flexpm/kernel/space/power_cells.hpp>
#include <flexpm/kernel/space/wall_cuts.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <tuple>

namespace flexpm {
namespace {

void require_sound(const WeightedPoints& given)
{
    if (given.points.empty()) refuse("weighted_cells: points", 0.0, "", "must be >= 1; give one");
    if (given.points.size() != given.weights.size()) {
        refuse("weighted_cells: weights", std::to_string(given.weights.size()),
            "must be one a point, " + std::to_string(given.points.size()) + "; complete them");
    }
    for (std::size_t i = 0; i < given.points.size(); ++i) {
        if (is_finite(given.points[i]) && std::isfinite(given.weights[i])) continue;
        refuse("weighted_cells: point " + std::to_string(i), place(given.points[i]),
            "and its weight must be finite; correct it");
    }
    std::vector<int> order(given.points.size());
    std::iota(order.begin(), order.end(), 0);
    const auto key = [&](int i) {
        const Vector& p = given.points[i];
        return std::tie(p.x, p.y, p.z);
    };
    std::sort(order.begin(), order.end(), [&](int i, int j) { return key(i) < key(j); });
    for (std::size_t k = 1; k < order.size(); ++k)
        if (key(order[k - 1]) == key(order[k])) {
            refuse("weighted_cells: point " + std::to_string(order[k]),
                place(given.points[order[k]]),
                "is that of point " + std::to_string(order[k - 1]) + ", must be another; move it");
        }
}

/// Spheres with the same cells: their smallest radius is 0.
std::vector<Sphere> spheres_of(const WeightedPoints& given)
{
    const double least = *std::min_element(given.weights.begin(), given.weights.end());
    std::vector<Sphere> spheres;
    for (std::size_t i = 0; i < given.points.size(); ++i)
        spheres.push_back({ given.points[i], std::sqrt(given.weights[i] - least) });
    return spheres;
}

}  // namespace

WeightedCells weighted_cells(const WeightedPoints& given, const Solid& solid)
{
    require_sound(given);
    const double close =
        zero_edge * std::cbrt(solid.volume / static_cast<double>(given.points.size()));
    WeightedCells cells;
    cells.complex = power_cells(spheres_of(given), solid);
    cut_by_walls(cells.complex, solid, close);
    merge_close_vertices(cells.complex, close);
    cells.volumes = cell_volumes(cells.complex);
    cells.centroids = cell_centroids(cells.complex, given.points, cells.volumes);
    return cells;
}

}  // namespace flexpm
