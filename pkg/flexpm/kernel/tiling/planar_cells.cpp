// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Neighbours are found by the two directions of an edge.
#include <flexpm/kernel/tiling/planar_cells.hpp>

#include <flexpm/kernel/geometry/polygon.hpp>
#include <flexpm/kernel/geometry/reference_point.hpp>

#include <algorithm>
#include <cmath>

namespace flexpm {

namespace {

/// Cells and vertices, without empty cells and unused vertices; `index` of each vertex.
Tessellation number_vertices(const PlanarCells& cells, std::vector<int>& index)
{
    Tessellation t;
    index.assign(cells.vertices.size(), -1);
    t.cell_offsets.push_back(0);
    for (const Loop& loop : cells.cells) {
        if (loop.empty()) continue;
        t.disc_of_cell.push_back(t.cells());
        for (int v : loop) {
            if (index[v] < 0) {
                index[v] = static_cast<int>(t.vertices.size());
                t.vertices.push_back(cells.vertices[v]);
            }
            t.cell_vertices.push_back(index[v]);
        }
        t.cell_offsets.push_back(static_cast<int>(t.cell_vertices.size()));
    }
    return t;
}

int value_of(const std::map<VertexPair, int>& values, VertexPair edge)
{
    const auto at = values.find(edge);
    return at == values.end() ? -1 : at->second;
}

struct JointedEdge {
    SharedEdge edge;
    int joint;
};

/// Contacts and boundary edges of numbered cells.
void find_edges(const PlanarCells& from, const std::vector<Loop>& loops,
    const std::vector<int>& index, Tiling& tiling)
{
    const EdgeOwners owners(loops);
    std::vector<JointedEdge> shared;
    for (int c = 0; c < static_cast<int>(loops.size()); ++c) {
        for (std::size_t k = 0; k < loops[c].size(); ++k) {
            const int u = loops[c][k], v = loops[c][(k + 1) % loops[c].size()];
            const int other = owners.left_of(v, u);
            if (other == EdgeOwners::none) {
                tiling.cells.boundary_edges.push_back(
                    { c, index[u], index[v], value_of(from.sides, undirected(u, v)) });
            } else if (other > c) {
                shared.push_back(
                    { { c, other, index[u], index[v] }, value_of(from.joints, undirected(u, v)) });
            }
        }
    }
    std::stable_sort(shared.begin(), shared.end(), [](const JointedEdge& i, const JointedEdge& j) {
        return std::pair(i.edge.cell_a, i.edge.cell_b) < std::pair(j.edge.cell_a, j.edge.cell_b);
    });
    for (const JointedEdge& e : shared) {
        tiling.cells.shared_edges.push_back(e.edge);
        tiling.edge_joint.push_back(e.joint);
    }
    tiling.cells.uncollapsed_shared_edges = static_cast<int>(shared.size());
}

}  // namespace

EdgeOwners::EdgeOwners(const std::vector<Loop>& cells)
{
    for (std::size_t c = 0; c < cells.size(); ++c)
        add(cells[c], static_cast<int>(c));
}

void EdgeOwners::add(const Loop& loop, int cell)
{
    for (std::size_t k = 0; k < loop.size(); ++k)
        cell_of[{ loop[k], loop[(k + 1) % loop.size()] }] = cell;
}

void EdgeOwners::remove(const Loop& loop)
{
    for (std::size_t k = 0; k < loop.size(); ++k)
        cell_of.erase({ loop[k], loop[(k + 1) % loop.size()] });
}

int EdgeOwners::left_of(int from, int to) const
{
    return cell_of.count({ from, to }) ? cell_of.at({ from, to }) : none;
}

std::vector<Point> polygon_of(const PlanarCells& cells, const Loop& loop)
{
    std::vector<Point> polygon;
    for (int v : loop)
        polygon.push_back(cells.vertices[v]);
    return polygon;
}

PlanarCells planar_cells(const Tessellation& t)
{
    PlanarCells cells;
    cells.vertices = t.vertices;
    for (int c = 0; c < t.cells(); ++c) {
        const auto first = t.cell_vertices.begin() + t.cell_offsets[c];
        cells.add_cell({ first, first + t.vertices_of(c) }, c, true);
        cells.laguerre[c] = t.is_laguerre(c);
    }
    for (const BoundaryEdge& e : t.boundary_edges)
        cells.sides[undirected(e.vertex_0, e.vertex_1)] = e.side;
    return cells;
}

Tiling make_tiling(const PlanarCells& cells, const std::vector<Disc>& discs)
{
    Tiling tiling;
    std::vector<int> index;
    tiling.cells = number_vertices(cells, index);
    std::vector<Loop> loops;
    for (std::size_t c = 0; c < cells.cells.size(); ++c) {
        if (cells.cells[c].empty()) continue;
        loops.push_back(cells.cells[c]);
        tiling.origin.push_back(cells.origin[c]);
        tiling.cells.laguerre.push_back(cells.laguerre[c]);
        tiling.discs.push_back(cells.whole[c] ? discs[cells.origin[c]]
                                              : disc_of_area(polygon_of(cells, cells.cells[c])));
    }
    find_edges(cells, loops, index, tiling);
    return tiling;
}

double enclosed_area(const Tessellation& t)
{
    double twice = 0.0;
    const Point origin = t.vertices.front();
    for (const BoundaryEdge& e : t.boundary_edges)
        twice += cross(t.vertices[e.vertex_0] - origin, t.vertices[e.vertex_1] - origin);
    return 0.5 * twice;
}

}  // namespace flexpm
