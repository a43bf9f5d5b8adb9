// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Triangles of the faces, gathered by grain.
#include <flexpm/kernel/space/fan_meshes.hpp>

#include <flexpm/kernel/space/face_triangles.hpp>

#include <algorithm>
#include <string>

namespace flexpm {
namespace {

/// Triangles of each cell's surface, counter-clockwise as seen from outside.
std::vector<std::vector<FaceTriangle>> surfaces(const Polyhedra& cells)
{
    std::vector<std::vector<FaceTriangle>> result(cells.cells());
    for (std::size_t f = 0; f < cells.faces.size(); ++f) {
        const PolyhedronFace& face = cells.faces[f];
        for (const auto& t : face_triangles(cells.vertices, cells.corners(static_cast<int>(f)))) {
            result[face.cell_a].push_back(t);
            if (face.cell_b >= 0) result[face.cell_b].push_back({ t[0], t[2], t[1] });
        }
    }
    return result;
}

void add_grain(
    FanMeshes& meshes, const Polyhedra& cells, int c, const std::vector<FaceTriangle>& surface)
{
    std::vector<int> own;
    for (const FaceTriangle& t : surface)
        own.insert(own.end(), t.begin(), t.end());
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    const auto node = [&](int vertex) {
        return static_cast<int>(std::lower_bound(own.begin(), own.end(), vertex) - own.begin());
    };
    const int centre = static_cast<int>(own.size());
    for (const auto& [p, q, r] : surface) {
        const double volume =
            six_volumes(cells.centres[c], cells.vertices[p], cells.vertices[q], cells.vertices[r])
            / 6.0;
        if (!(volume > 0.0)) {
            refuse("fan_meshes: sphere " + std::to_string(cells.sphere_of_cell[c])
                    + ": volume of a tetrahedron of its cell",
                volume, "m^3",
                "must be above 0, at " + place(cells.centres[c]) + "; move or remove the sphere");
        }
        meshes.elements.push_back({ centre, node(p), node(q), node(r) });
        meshes.volumes.push_back(volume);
    }
    meshes.node_vertices.insert(meshes.node_vertices.end(), own.begin(), own.end());
    meshes.node_vertices.push_back(-1);
    meshes.node_offsets.push_back(static_cast<std::int64_t>(meshes.node_vertices.size()));
    meshes.element_offsets.push_back(static_cast<std::int64_t>(meshes.elements.size()));
}

}  // namespace

FanMeshes fan_meshes(const Polyhedra& cells)
{
    FanMeshes meshes;
    meshes.node_offsets.push_back(0);
    meshes.element_offsets.push_back(0);
    const auto of_cells = surfaces(cells);
    for (int c = 0; c < cells.cells(); ++c)
        add_grain(meshes, cells, c, of_cells[c]);
    return meshes;
}

}  // namespace flexpm
