// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Deviation D31: a packing of the box around the outline is clipped; grains on it are cut,
/// as by a saw.
#include <flexpm/kernel/tiling/outline_cells.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/geometry/tessellation.hpp>
#include <flexpm/kernel/tiling/shape_repair.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace flexpm {

namespace {

constexpr double area_tolerance = 1e-12;  ///< relative

/// A rectangle around outline and discs: no edge of a cell lies on the outline by itself.
Outline box_around(const std::vector<Disc>& discs, const PolygonOutline& outline)
{
    Point low = outline.corners.front(), high = low;
    double largest = 0.0;
    const auto include = [&](Point p) {
        low = { std::min(low.x, p.x), std::min(low.y, p.y) };
        high = { std::max(high.x, p.x), std::max(high.y, p.y) };
    };
    for (Point p : outline.corners)
        include(p);
    for (const Disc& d : discs) {
        include(d.centre);
        largest = std::max(largest, d.radius);
    }
    low = low - Point { largest, largest };
    high = high + Point { largest, largest };
    return Outline::polygon({ low, { high.x, low.y }, high, { low.x, high.y } });
}

/// Grains of which a part lies inside.
int held_grains(const PlanarCells& cells)
{
    return static_cast<int>(std::set<int>(cells.origin.begin(), cells.origin.end()).size());
}

void check_area(const Tessellation& t, double expected)
{
    double area = 0.0;
    for (int c = 0; c < t.cells(); ++c)
        area += cell_area(t, c);
    if (!(std::abs(area - expected) <= area_tolerance * expected)) {
        fail("area of the cells", number(area) + " m^2",
            "must be the area of the outline,  " + number(expected)
                + " m^2; change the outline or the seed");
    }
}

}  // namespace

Tiling cells_in_outline(
    const std::vector<Disc>& discs, const PolygonOutline& outline, double short_edge)
{
    const Tessellation all = tessellate(discs, box_around(discs, outline), { short_edge, true });
    std::vector<Disc> of_cells;
    for (int disc : all.disc_of_cell)
        of_cells.push_back(discs[disc]);
    PlanarCells cells = clip_cells(all, outline);
    const double mean = outline.area() / std::max(1, held_grains(cells));
    merge_slivers(cells, mean);
    split_to_stars(cells);
    merge_slivers(cells, mean);
    straighten_edges(cells);
    collapse_short_edges(cells, short_edge);
    Tiling tiling = make_tiling(cells, of_cells);
    check_area(tiling.cells, outline.area());
    return tiling;
}

}  // namespace flexpm
