// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The way from spheres to numbered cells.
#include <flexpm/kernel/space/polyhedra.hpp>

#include <flexpm/kernel/space/face_triangles.hpp>
#include <flexpm/kernel/space/power_cells.hpp>
#include <flexpm/kernel/space/short_edges.hpp>
#include <flexpm/kernel/space/sphere_checks.hpp>
#include <flexpm/kernel/space/wall_cuts.hpp>

#include <algorithm>
#include <iterator>
#include <string>
#include <tuple>

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

/// Those of some cells in order that holes have not taken out.
std::vector<int> not_gone(const std::vector<int>& some, const std::vector<int>& gone)
{
    std::vector<int> left;
    std::set_difference(
        some.begin(), some.end(), gone.begin(), gone.end(), std::back_inserter(left));
    return left;
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

/// Numbering of the cells without the hidden ones, and of vertices in the order in which faces use
/// them.
void number_cells(Polyhedra& p, CellComplex& complex, const std::vector<Vector>& centres)
{
    std::vector<int> cell_of_sphere(complex.cells, -1), new_index(complex.vertices.size(), -1);
    for (int s = 0; s < complex.cells; ++s) {
        if (std::binary_search(p.hidden_spheres.begin(), p.hidden_spheres.end(), s)) continue;
        cell_of_sphere[s] = p.cells();
        p.sphere_of_cell.push_back(s);
        p.centres.push_back(centres[s]);
    }
    // a cell may have several faces on a notch
    std::stable_sort(
        complex.faces.begin(), complex.faces.end(), [](const CellFace& a, const CellFace& b) {
            return std::tuple(a.second < 0, a.first, a.second, a.wall)
                < std::tuple(b.second < 0, b.first, b.second, b.wall);
        });
    p.face_offsets.push_back(0);
    for (CellFace& face : complex.faces) {
        const int second = face.second < 0 ? -1 : cell_of_sphere[face.second];
        p.faces.push_back({ cell_of_sphere[face.first], second, face.wall });
        if (second >= 0) p.joints.push_back(face.joint);
        for (int old : face.corners) {
            int& v = new_index[old];
            if (v < 0) {
                v = static_cast<int>(p.vertices.size());
                p.vertices.push_back(complex.vertices[old]);
            }
            p.face_vertices.push_back(v);
        }
        p.face_offsets.push_back(static_cast<int>(p.face_vertices.size()));
    }
}

/// Turn a polygon around without a change of its triangles: a bent one may be cut by other corners
/// as well, and with other triangles, of which the collapse of edges knows nothing.
void turn_around(const std::vector<Vector>& vertices, std::vector<int>& corners)
{
    const int tip = face_triangles(vertices, corners).front()[0];
    std::rotate(corners.begin(), std::find(corners.begin(), corners.end(), tip), corners.end());
    std::reverse(corners.begin() + 1, corners.end());
}

/// Take cells out: faces that they share with others become flanks of these.
/// @param gone  cells, in order
void take_out(CellComplex& complex, const std::vector<int>& gone)
{
    const auto is_gone = [&](int cell) {
        return cell >= 0 && std::binary_search(gone.begin(), gone.end(), cell);
    };
    std::vector<CellFace> kept;
    for (CellFace& face : complex.faces) {
        const bool first = is_gone(face.first), second = is_gone(face.second);
        if (first && (second || face.second < 0)) continue;
        if (first) {
            std::swap(face.first, face.second);
            turn_around(complex.vertices, face.corners);
        }
        if (first || second) {
            face.second = -1;
            face.wall = complex.flanks;
        }
        kept.push_back(std::move(face));
    }
    complex.faces = std::move(kept);
}

/// Volumes between the triangles of the faces, which a collapse has bent.
void add_volumes(Polyhedra& p)
{
    p.volumes.assign(p.cells(), 0.0);
    for (std::size_t f = 0; f < p.faces.size(); ++f) {
        const auto& [cell_a, cell_b, wall] = p.faces[f];
        for (const auto& t : face_triangles(p.vertices, p.corners(static_cast<int>(f)))) {
            const Vector a = p.vertices[t[0]], b = p.vertices[t[1]], c = p.vertices[t[2]];
            p.volumes[cell_a] += six_volumes(p.centres[cell_a], a, b, c) / 6.0;
            if (cell_b >= 0) p.volumes[cell_b] += six_volumes(p.centres[cell_b], a, c, b) / 6.0;
        }
    }
}

}  // namespace

void set_holes(Polyhedra& p, const CutCells& cut, int first_wall)
{
    p.hole_cuts = cut.holes;
    if (!cut.holes.empty()) p.first_hole = first_wall;
}

void require_short_edge(double short_edge)
{
    if (std::isfinite(short_edge) && short_edge >= 0.0) return;
    refuse("polyhedra: short_edge", short_edge, "m",
        "must be finite and >= 0; use 0 to collapse none");
}

void finish_cells(
    Polyhedra& p, CellComplex& complex, const std::vector<Vector>& centres, double short_edge)
{
    const auto is_hidden = [&](int cell) {
        return std::binary_search(p.hidden_spheres.begin(), p.hidden_spheres.end(), cell);
    };
    for (const CellFace& face : complex.faces) {
        const bool is_contact =
            face.second >= 0 && !is_hidden(face.first) && !is_hidden(face.second);
        p.uncollapsed_contacts += is_contact ? 1 : 0;
    }
    p.short_edges = collapse_short_edges(complex, centres, short_edge);
    // the two sides of a notch
    for (CellFace& face : complex.faces)
        if (face.wall >= complex.flanks && face.wall < p.first_hole)
            begin_alike(complex.vertices, face.corners);
    take_out(complex, p.hidden_spheres);
    p.contacts = count_contacts(complex);
    number_cells(p, complex, centres);
    add_volumes(p);
}

Polyhedra polyhedra(
    const std::vector<Sphere>& given, const Solid& solid, const PolyhedraOptions& options)
{
    require_spheres_inside(given, solid);
    require_short_edge(options.short_edge);
    const double diameter = mean_diameter(given);
    CellComplex complex = power_cells(given, solid);
    cut_by_walls(complex, solid, zero_edge * diameter);
    merge_close_vertices(complex, zero_edge * diameter);
    std::vector<Sphere> spheres = given;
    std::vector<bool> moved(given.size());
    CutCells cut =
        cut_cells(complex, solid, diameter, options.joints, options.notches, options.holes);
    for (int source : cut.sources) {
        spheres.push_back(given[source]);
        moved[source] = true;  // both pieces are meshed from their centroids
        moved.push_back(true);
    }

    Polyhedra p;
    p.joint_cuts = std::move(cut.joints);
    set_holes(p, cut, first_hole_wall(solid, options.notches));
    const auto volumes = cell_volumes(complex);
    p.hidden_spheres = find_hidden(complex, volumes);
    const std::vector<int> hidden = not_gone(p.hidden_spheres, cut.gone);
    if (!options.allow_hidden) refuse_hidden(spheres, hidden);
    const double mean_volume = solid.volume / static_cast<double>(given.size());
    require_volumes(spheres, p.hidden_spheres, volumes, zero_volume * mean_volume);

    std::vector<Vector> origins;
    for (const Sphere& sphere : spheres)
        origins.push_back(sphere.centre);
    std::vector<Vector> centres = cell_centroids(complex, origins, volumes);
    const auto depth = depths(complex, spheres);
    for (std::size_t s = 0; s < spheres.size(); ++s) {
        if (depth[s] < well_inside * std::cbrt(volumes[s])) moved[s] = true;
        if (!moved[s]) centres[s] = spheres[s].centre;
    }
    finish_cells(p, complex, centres, options.short_edge);
    p.hidden_spheres = hidden;
    for (int c = 0; c < p.cells(); ++c) {
        int& sphere = p.sphere_of_cell[c];
        if (moved[sphere]) p.moved_centres.push_back(c);
        if (sphere >= static_cast<int>(given.size())) sphere = cut.sources[sphere - given.size()];
    }
    return p;
}

}  // namespace flexpm
