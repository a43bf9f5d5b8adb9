// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Numbering of the cells and vertices of a power diagram whose short edges are collapsed.
#include <flexpm/kernel/geometry/tessellation.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/geometry/edge_collapse.hpp>
#include <flexpm/kernel/geometry/power_diagram.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace flexpm {
namespace {

/// Length over the mean diameter below which an edge is round-off of cells that meet in one point.
constexpr double zero_edge = 1e-10;

int count_shared_edges(const PowerDiagram& diagram)
{
    int twice = 0;
    for (const auto& cell : diagram.cells)
        for (const CellEdge& e : cell)
            twice += e.neighbour >= 0;
    return twice / 2;
}

/// Discs that a message names by their numbers.
constexpr std::size_t named = 20;

/// @param hidden  numbers of the discs without a cell
[[noreturn]] void refuse_hidden(
    const std::vector<Disc>& discs, const std::vector<std::size_t>& hidden)
{
    const Disc& first = discs[hidden.front()];
    if (hidden.size() == 1) {
        refuse("tessellate: disc " + std::to_string(hidden.front()) + ": radius", first.radius, "m",
            "is hidden by others at " + place(first.centre)
                + ", must have a cell; remove, move or drop it");
    }
    std::string numbers;
    for (std::size_t k = 0; k < std::min(hidden.size(), named); ++k)
        numbers += (k > 0 ? ", " : "") + std::to_string(hidden[k]);
    refuse("tessellate: hidden discs",
        std::to_string(hidden.size()) + " (" + numbers + (hidden.size() > named ? ", ..." : "")
            + ")",
        "must have a cell, the first at " + place(first.centre) + "; remove, move or drop them");
}

void add_edges(Tessellation& t, const std::vector<CellEdge>& cell, int index,
    const std::vector<int>& cell_of_disc)
{
    const int* v = t.cell_vertices.data() + t.cell_offsets[index];
    for (std::size_t k = 0; k < cell.size(); ++k) {
        const int start = v[k], end = v[(k + 1) % cell.size()];
        if (cell[k].neighbour < 0)
            t.boundary_edges.push_back({ index, start, end, cell[k].side });
        else if (cell_of_disc[cell[k].neighbour] > index)
            t.shared_edges.push_back({ index, cell_of_disc[cell[k].neighbour], start, end });
    }
}

/// Number cells without the hidden ones, and vertices in the order in which the cells use them.
Tessellation number_cells(const PowerDiagram& diagram, const std::vector<bool>& merged)
{
    Tessellation t;
    const int discs = static_cast<int>(diagram.cells.size());
    std::vector<int> cell_of_disc(discs, -1), new_index(diagram.vertices.size(), -1);
    t.cell_offsets.push_back(0);
    for (int i = 0; i < discs; ++i) {
        if (diagram.cells[i].empty()) {
            t.hidden_discs.push_back(i);
            continue;
        }
        cell_of_disc[i] = t.cells();
        t.disc_of_cell.push_back(i);
        for (const CellEdge& e : diagram.cells[i]) {
            int& v = new_index[e.vertex];
            if (v < 0) {
                v = static_cast<int>(t.vertices.size());
                t.vertices.push_back(diagram.vertices[e.vertex]);
                if (merged[e.vertex]) t.merged_vertices.push_back(v);
            }
            t.cell_vertices.push_back(v);
        }
        t.cell_offsets.push_back(static_cast<int>(t.cell_vertices.size()));
    }
    for (int c = 0; c < t.cells(); ++c)
        add_edges(t, diagram.cells[t.disc_of_cell[c]], c, cell_of_disc);
    std::sort(
        t.shared_edges.begin(), t.shared_edges.end(), [](const SharedEdge& e, const SharedEdge& f) {
            return e.cell_a != f.cell_a ? e.cell_a < f.cell_a : e.cell_b < f.cell_b;
        });
    return t;
}

}  // namespace

Tessellation tessellate(
    const std::vector<Disc>& discs, const Outline& outline, const TessellationOptions& options)
{
    PowerDiagram diagram = power_diagram(discs, outline);
    if (!(std::isfinite(options.short_edge) && options.short_edge >= 0.0)) {
        refuse("tessellate: short_edge", options.short_edge, "m",
            "must be finite and >= 0; use 0 to keep every edge");
    }
    double mean_diameter = 0.0;
    for (const Disc& d : discs)
        mean_diameter += 2.0 * d.radius / static_cast<double>(discs.size());
    const double zero = zero_edge * mean_diameter;
    collapse_edges(diagram, outline, zero, -zero * mean_diameter);

    // a disc that holds all of a circle has no corner
    const bool any = std::any_of(diagram.cells.begin(), diagram.cells.end(),
        [](const std::vector<CellEdge>& cell) { return !cell.empty(); });
    std::vector<std::size_t> hidden;
    for (std::size_t i = 0; i < discs.size(); ++i) {
        auto& cell = diagram.cells[i];
        const bool is_sliver = !cell.empty() && cell.size() < 3;
        if (outline.is_circle() && (!any || is_sliver)) {
            refuse("tessellate: discs", static_cast<double>(discs.size()), "",
                "must be enough to span an area in a circle; add discs or use a polygon");
        }
        // some discs in nearly one place may keep no area
        if (!any || is_sliver || (cell.empty() && !options.allow_hidden)) hidden.push_back(i);
    }
    if (!hidden.empty()) refuse_hidden(discs, hidden);
    const int uncollapsed = count_shared_edges(diagram);
    const auto merged = collapse_edges(diagram, outline, options.short_edge, 0.0);
    Tessellation t = number_cells(diagram, merged);
    t.uncollapsed_shared_edges = uncollapsed;
    return t;
}

}  // namespace flexpm
