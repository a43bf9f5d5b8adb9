// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  A grid of squares holds the boxes of cells.
#include <flexpm/kernel/tiling/cell_index.hpp>

#include <flexpm/kernel/geometry/polygon.hpp>

#include <algorithm>
#include <cmath>

namespace flexpm {

namespace {

/// Side of a square over that of one which has the area of the box for each cell, and the most
/// squares in a row.
constexpr double square_share = 0.25;
constexpr int most_squares = 4096;

Point lower(Point a, Point b) { return { std::min(a.x, b.x), std::min(a.y, b.y) }; }
Point upper(Point a, Point b) { return { std::max(a.x, b.x), std::max(a.y, b.y) }; }

}  // namespace

CellIndex::CellIndex(PlanarCells& c) :
    cells(c),
    around(c.vertices.size()),
    owners({}),
    low(c.vertices.front())
{
    Box box { low, low };
    for (Point p : cells.vertices)
        box = { lower(box.low, p), upper(box.high, p) };
    low = box.low;
    const double width = box.high.x - box.low.x, height = box.high.y - box.low.y;
    square = std::max(square_share * std::sqrt(width * height / cells.cells.size()),
        std::max(width, height) / most_squares);
    columns = std::max(1, static_cast<int>(std::ceil(width / square)));
    rows = std::max(1, static_cast<int>(std::ceil(height / square)));
    in_square.resize(static_cast<std::size_t>(columns) * rows);
    for (std::size_t i = 0; i < cells.cells.size(); ++i)
        add(static_cast<int>(i));
}

bool CellIndex::is_boundary(int u, int v) const
{
    return owners.left_of(u, v) == EdgeOwners::none || owners.left_of(v, u) == EdgeOwners::none;
}

double CellIndex::longest_edge()
{
    while (!lengths.empty()) {
        const auto [length, u, v] = lengths.top();
        const bool is_there =
            owners.left_of(u, v) != EdgeOwners::none || owners.left_of(v, u) != EdgeOwners::none;
        if (is_there && norm(cells.vertices[v] - cells.vertices[u]) == length) return length;
        lengths.pop();
    }
    return 0.0;
}

std::vector<int> CellIndex::near(Point a, Point b, double within) const
{
    // round-off of places far away
    const double margin = within + 1e-3 * square;
    const double top = std::max(a.y, b.y) + margin, bottom = std::min(a.y, b.y) - margin;
    std::vector<int> found;
    if (top < low.y || bottom > low.y + rows * square) return found;
    ++search;
    for (int row = row_of(bottom), last = row_of(top); row <= last; ++row) {
        // the part of the segment between the lower and the upper side of the row
        double first_share = 0.0, last_share = 1.0;
        if (a.y != b.y) {
            const double lower = row == 0 ? bottom : low.y + row * square - margin,
                         upper = row == rows - 1 ? top : low.y + (row + 1) * square + margin;
            const double s = (lower - a.y) / (b.y - a.y), t = (upper - a.y) / (b.y - a.y);
            first_share = std::clamp(std::min(s, t), 0.0, 1.0);
            last_share = std::clamp(std::max(s, t), 0.0, 1.0);
        }
        const double x = a.x + first_share * (b.x - a.x), y = a.x + last_share * (b.x - a.x);
        const double left = std::min(x, y) - margin, right = std::max(x, y) + margin;
        if (right < low.x || left > low.x + columns * square) continue;
        for (int column = column_of(left), end = column_of(right); column <= end; ++column) {
            for (int cell : in_square[static_cast<std::size_t>(row) * columns + column]) {
                if (seen[cell] == search) continue;
                seen[cell] = search;
                if (is_close(boxes[cell], a, b, margin)) found.push_back(cell);
            }
        }
    }
    std::sort(found.begin(), found.end());
    return found;
}

bool CellIndex::is_close(const Box& box, Point a, Point b, double within) const
{
    const Point least = lower(a, b), most = upper(a, b);
    if (box.low.x > most.x + within || box.high.x < least.x - within || box.low.y > most.y + within
        || box.high.y < least.y - within)
        return false;
    const Point way = b - a, middle = 0.5 * (box.low + box.high);
    const double room = 0.5 * norm(box.high - box.low) + within;
    return std::abs(cross(way, middle - a)) <= room * norm(way);
}

bool CellIndex::is_in_a_cell(Point p) const
{
    const auto& candidates =
        in_square[static_cast<std::size_t>(row_of(p.y)) * columns + column_of(p.x)];
    return std::any_of(candidates.begin(), candidates.end(), [&](int cell) {
        const Loop& loop = cells.cells[cell];
        bool inside = false;
        for (std::size_t k = 0; k < loop.size(); ++k) {
            const Point a = cells.vertices[loop[k]],
                        b = cells.vertices[loop[(k + 1) % loop.size()]];
            if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
                inside = !inside;
        }
        return inside;
    });
}

void CellIndex::split(int cell, Loop first, Loop second)
{
    take_out_of_squares(cell);
    owners.remove(cells.cells[cell]);
    for (int v : cells.cells[cell]) {
        auto& at = around[v];
        at.erase(std::find(at.begin(), at.end(), cell));
    }
    cells.cells[cell] = std::move(first);
    cells.reshape(cell);
    cells.add_cell(std::move(second), cells.origin[cell], false);
    add(cell);
    add(static_cast<int>(cells.cells.size()) - 1);
}

void CellIndex::divide(VertexPair edge, int vertex)
{
    if (around.size() <= static_cast<std::size_t>(vertex)) around.resize(vertex + 1);
    for (int cell :
        { owners.left_of(edge.first, edge.second), owners.left_of(edge.second, edge.first) }) {
        if (cell == EdgeOwners::none) continue;
        Loop& loop = cells.cells[cell];
        owners.remove(loop);
        for (std::size_t k = 0; k < loop.size(); ++k) {
            if (undirected(loop[k], loop[(k + 1) % loop.size()]) != edge) continue;
            loop.insert(loop.begin() + static_cast<std::ptrdiff_t>(k) + 1, vertex);
            break;
        }
        owners.add(loop, cell);
        auto& at = around[vertex];
        at.insert(std::lower_bound(at.begin(), at.end(), cell), cell);
    }
    for (auto* labels : { &cells.sides, &cells.joints }) {
        const auto at = labels->find(edge);
        if (at == labels->end()) continue;
        const int label = at->second;
        labels->erase(at);
        labels->emplace(undirected(edge.first, vertex), label);
        labels->emplace(undirected(vertex, edge.second), label);
    }
    note_length(edge.first, vertex);
    note_length(vertex, edge.second);
}

void CellIndex::remove(int vertex)
{
    for (int cell : around[vertex]) {
        Loop& loop = cells.cells[cell];
        owners.remove(loop);
        loop.erase(std::find(loop.begin(), loop.end(), vertex));
        owners.add(loop, cell);
        for (std::size_t k = 0; k < loop.size(); ++k)
            note_length(loop[k], loop[(k + 1) % loop.size()]);
    }
    around[vertex].clear();
}

void CellIndex::move(int vertex, Point place)
{
    cells.vertices[vertex] = place;
    for (int cell : around[vertex]) {
        cells.laguerre[cell] = 0;  // which may keep its disc
        take_out_of_squares(cell);
        place_in_squares(cell);
        const Loop& loop = cells.cells[cell];
        const std::size_t n = loop.size(),
                          k = std::find(loop.begin(), loop.end(), vertex) - loop.begin();
        note_length(loop[(k + n - 1) % n], vertex);
        note_length(vertex, loop[(k + 1) % n]);
    }
}

void CellIndex::add(int cell)
{
    const Loop& loop = cells.cells[cell];
    owners.add(loop, cell);
    for (std::size_t k = 0; k < loop.size(); ++k) {
        auto& at = around[loop[k]];
        at.insert(std::lower_bound(at.begin(), at.end(), cell), cell);
        note_length(loop[k], loop[(k + 1) % loop.size()]);
    }
    if (seen.size() <= static_cast<std::size_t>(cell)) {
        seen.resize(cell + 1, 0);
        boxes.resize(cell + 1);
    }
    place_in_squares(cell);
}

void CellIndex::place_in_squares(int cell)
{
    const Loop& loop = cells.cells[cell];
    const Point first = cells.vertices[loop.front()];
    Box box { first, first };
    for (int v : loop)
        box = { lower(box.low, cells.vertices[v]), upper(box.high, cells.vertices[v]) };
    boxes[cell] = box;
    diagonal = std::max(diagonal, norm(box.high - box.low));
    for (int row = row_of(box.low.y), top = row_of(box.high.y); row <= top; ++row)
        for (int column = column_of(box.low.x), end = column_of(box.high.x); column <= end;
             ++column)
            in_square[static_cast<std::size_t>(row) * columns + column].push_back(cell);
}

void CellIndex::take_out_of_squares(int cell)
{
    const Box box = boxes[cell];
    for (int row = row_of(box.low.y), top = row_of(box.high.y); row <= top; ++row) {
        for (int column = column_of(box.low.x), end = column_of(box.high.x); column <= end;
             ++column) {
            auto& there = in_square[static_cast<std::size_t>(row) * columns + column];
            there.erase(std::find(there.begin(), there.end(), cell));
        }
    }
}

void CellIndex::note_length(int u, int v)
{
    const VertexPair edge = undirected(u, v);
    lengths.push({ norm(cells.vertices[edge.second] - cells.vertices[edge.first]), edge.first,
        edge.second });
}

int CellIndex::column_of(double x) const
{
    return static_cast<int>(std::clamp(std::floor((x - low.x) / square), 0.0, columns - 1.0));
}

int CellIndex::row_of(double y) const
{
    return static_cast<int>(std::clamp(std::floor((y - low.y) / square), 0.0, rows - 1.0));
}

}  // namespace flexpm
