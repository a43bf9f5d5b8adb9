// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Contacts come first; volumes are summed over tetrahedra.
#include <flexpm/kernel/space/finished_cells.hpp>

#include <flexpm/kernel/space/face_triangles.hpp>
#include <flexpm/kernel/space/short_edges.hpp>

#include <algorithm>
#include <tuple>

namespace flexpm {
namespace {

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
    std::sort(complex.faces.begin(), complex.faces.end(), [](const CellFace& a, const CellFace& b) {
        return std::tuple(a.second < 0, a.first, a.second, a.wall)
            < std::tuple(b.second < 0, b.first, b.second, b.wall);
    });
    p.face_offsets.push_back(0);
    for (const CellFace& face : complex.faces) {
        const int second = face.second < 0 ? -1 : cell_of_sphere[face.second];
        p.faces.push_back({ cell_of_sphere[face.first], second, face.wall });
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

void require_short_edge(double short_edge)
{
    if (std::isfinite(short_edge) && short_edge >= 0.0) return;
    refuse("polyhedra: short_edge", short_edge, "m",
        "must be finite and >= 0; use 0 to keep every edge");
}

void finish_cells(Polyhedra& p, CellComplex& complex, const std::vector<Vector>& centres,
    double short_edge)
{
    p.uncollapsed_contacts = count_contacts(complex);
    p.short_edges = collapse_short_edges(complex, centres, short_edge);
    p.contacts = count_contacts(complex);
    number_cells(p, complex, centres);
    add_volumes(p);
}

}  // namespace flexpm
