// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The way from spheres to numbered cells.
#include <flexpm/kernel/space/polyhedra.hpp>

#include <flexpm/kernel/space/finished_cells.hpp>
#include <flexpm/kernel/space/power_cells.hpp>
#include <flexpm/kernel/space/sphere_checks.hpp>
#include <flexpm/kernel/space/wall_cuts.hpp>

#include <algorithm>
#include <string>

namespace flexpm {
namespace {

/// Volume over that of a mean cube below which a cell has none.
constexpr double zero_volume = 1e-12;
/// Distance of a centre from the faces of its cell over the cell's size below which it is moved.
constexpr double well_inside = 0.02;

/// Numbers of the spheres without a cell.
std::vector<int> find_hidden(const CellComplex& complex, const std::vector<double>& volumes)
{
    std::vector<bool> has_face(complex.cells, false);
    for (const CellFace& face : complex.faces) {
        has_face[face.first] = true;
        if (face.second >= 0) has_face[face.second] = true;
    }
    std::vector<int> hidden;
    for (int c = 0; c < complex.cells; ++c)
        if (!has_face[c] || volumes[c] == 0.0) hidden.push_back(c);
    return hidden;
}

void require_volumes(const std::vector<Sphere>& spheres, const std::vector<int>& hidden,
    const std::vector<double>& volumes, double least)
{
    for (std::size_t c = 0; c < volumes.size(); ++c) {
        if (volumes[c] > least || std::binary_search(hidden.begin(), hidden.end(), c)) continue;
        refuse("polyhedra: sphere " + std::to_string(c) + ": volume of its cell", volumes[c], "m^3",
            "must be above 0, at " + place(spheres[c].centre) + "; remove or move the sphere");
    }
}

/// Centroid of each cell.
std::vector<Vector> centroids(const CellComplex& complex, const std::vector<Sphere>& spheres,
    const std::vector<double>& volumes)
{
    std::vector<Vector> moments(complex.cells);
    const auto add = [&](int cell, const CellFace& face, double sign) {
        const Vector origin = spheres[cell].centre;
        const Vector a = complex.vertices[face.corners[0]] - origin;
        for (std::size_t k = 1; k + 1 < face.corners.size(); ++k) {
            const Vector b = complex.vertices[face.corners[k]] - origin;
            const Vector c = complex.vertices[face.corners[k + 1]] - origin;
            moments[cell] = moments[cell] + (sign / 24.0 * triple(a, b, c)) * (a + b + c);
        }
    };
    for (const CellFace& face : complex.faces) {
        add(face.first, face, 1.0);
        if (face.second >= 0) add(face.second, face, -1.0);
    }
    for (int c = 0; c < complex.cells; ++c)
        moments[c] = spheres[c].centre + (volumes[c] > 0.0 ? 1.0 / volumes[c] : 0.0) * moments[c];
    return moments;
}

/// Smallest distance of each sphere's centre from the planes of its cell's faces.
std::vector<double> depths(const CellComplex& complex, const std::vector<Sphere>& spheres)
{
    std::vector<double> result(complex.cells, 1e300);
    for (const CellFace& face : complex.faces) {
        const Vector area = area_vector(complex, face.corners),
                     at = complex.vertices[face.corners[0]];
        const double size = norm(area);
        if (!(size > 0.0)) continue;
        const auto lower = [&](int cell, double sign) {
            const double depth = sign * dot(area, at - spheres[cell].centre) / size;
            result[cell] = std::min(result[cell], depth);
        };
        lower(face.first, 1.0);
        if (face.second >= 0) lower(face.second, -1.0);
    }
    return result;
}

}  // namespace

Polyhedra polyhedra(
    const std::vector<Sphere>& spheres, const Solid& solid, const PolyhedraOptions& options)
{
    require_spheres_inside(spheres, solid);
    require_short_edge(options.short_edge);
    const double diameter = mean_diameter(spheres);
    CellComplex complex = power_cells(spheres, solid);
    cut_by_walls(complex, solid, zero_edge * diameter);
    merge_close_vertices(complex, zero_edge * diameter);

    Polyhedra p;
    const auto volumes = cell_volumes(complex);
    p.hidden_spheres = find_hidden(complex, volumes);
    if (!options.allow_hidden) refuse_hidden(spheres, p.hidden_spheres);
    const double mean_volume = solid.volume / static_cast<double>(spheres.size());
    require_volumes(spheres, p.hidden_spheres, volumes, zero_volume * mean_volume);

    std::vector<Vector> centres = centroids(complex, spheres, volumes);
    const auto depth = depths(complex, spheres);
    std::vector<bool> moved(spheres.size());
    for (std::size_t s = 0; s < spheres.size(); ++s) {
        moved[s] = depth[s] < well_inside * std::cbrt(volumes[s]);
        if (!moved[s]) centres[s] = spheres[s].centre;
    }
    finish_cells(p, complex, centres, options.short_edge);
    for (int c = 0; c < p.cells(); ++c)
        if (moved[p.sphere_of_cell[c]]) p.moved_centres.push_back(c);
    return p;
}

}  // namespace flexpm
