// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/geometry/tessellation.hpp>

#include "fuzz/bytes.hpp"
#include "fuzz/holds.hpp"
#include "fuzz/targets.hpp"

#include <stdexcept>
#include <vector>

namespace fuzz {

namespace {

using flexpm::Outline;
using flexpm::Point;
using flexpm::Tessellation;

/// On a coarse lattice at times: discs in rows, equal distances, centres on the outline.
double coordinate(Bytes& bytes)
{
    const double place = bytes.flag() ? bytes.share() : 0.125 * bytes.whole(0, 8);
    return bytes.wild(place);
}

Outline draw_outline(Bytes& bytes)
{
    if (bytes.flag()) return Outline::circle({ 0.5, 0.5 }, bytes.wild(0.5));
    std::vector<Point> corners = { { 0.0, 0.0 }, { 1.0, 0.0 }, { 1.0, 1.0 }, { 0.0, 1.0 } };
    if (bytes.flag()) {
        corners.clear();
        for (int k = bytes.whole(0, 6); k > 0; --k) {
            const double x = coordinate(bytes), y = coordinate(bytes);
            corners.push_back({ x, y });
        }
    }
    return Outline::polygon(corners);
}

/// All names that the cells give are there, and no cell is empty.
void check_cells(const Tessellation& t, std::size_t discs)
{
    const int vertices = static_cast<int>(t.vertices.size()), cells = t.cells();
    require(static_cast<int>(t.cell_offsets.size()) == cells + 1, "an offset for each cell");
    for (const Point& p : t.vertices)
        require(flexpm::is_finite(p), "finite vertices");
    for (int v : t.cell_vertices)
        require(v >= 0 && v < vertices, "vertices of cells exist");
    for (int c = 0; c < cells; ++c) {
        require(t.vertices_of(c) >= 3, "cells have three corners");
        require(flexpm::cell_area(t, c) > 0.0, "cells have an area");
        require(t.disc_of_cell[c] >= 0 && t.disc_of_cell[c] < static_cast<int>(discs),
            "discs of cells exist");
    }
    for (const flexpm::SharedEdge& e : t.shared_edges) {
        require(e.cell_a >= 0 && e.cell_a < e.cell_b && e.cell_b < cells, "cells of edges exist");
        require(e.vertex_0 != e.vertex_1, "edges have a length");
    }
    for (const flexpm::BoundaryEdge& e : t.boundary_edges)
        require(e.cell >= 0 && e.cell < cells, "cells of boundary edges exist");
    require(t.vertices.size() + static_cast<std::size_t>(cells) + 1
            == t.shared_edges.size() + t.boundary_edges.size() + 2,
        "Euler's formula");
}

}  // namespace

void tessellate(const std::uint8_t* data, std::size_t size)
{
    Bytes bytes(data, size);
    try {
        const Outline outline = draw_outline(bytes);
        flexpm::TessellationOptions o;
        o.allow_hidden = bytes.flag();
        o.short_edge = bytes.wild(0.2 * bytes.share());
        std::vector<flexpm::Disc> discs;
        for (int i = bytes.whole(0, 40); i > 0; --i) {
            const double x = coordinate(bytes), y = coordinate(bytes);
            discs.push_back({ { x, y }, bytes.wild(0.3 * bytes.share()) });
        }
        check_cells(flexpm::tessellate(discs, outline, o), discs.size());
    } catch (const std::invalid_argument&) {
    }
}

}  // namespace fuzz
