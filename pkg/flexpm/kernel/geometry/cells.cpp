// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Polygons of single cells, gathered from the common vertices.
#include <flexpm/kernel/geometry/cells.hpp>

#include <flexpm/kernel/geometry/polygon.hpp>

namespace flexpm {

std::vector<Point> cell_polygon(const Tessellation& t, int cell)
{
    std::vector<Point> polygon;
    for (int k = t.cell_offsets[cell]; k < t.cell_offsets[cell + 1]; ++k)
        polygon.push_back(t.vertices[t.cell_vertices[k]]);
    return polygon;
}

double cell_area(const Tessellation& t, int cell)
{
    return polygon_shape(cell_polygon(t, cell)).area;
}

}  // namespace flexpm
