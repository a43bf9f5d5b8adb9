// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Half-space by half-space; the rims of the cuts are chained to the faces on the wall.
#include <flexpm/kernel/space/wall_cuts.hpp>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <string>
#include <unordered_map>
#include <utility>

namespace flexpm {
namespace {

using Segment = std::pair<int, int>;

[[noreturn]] void fail_not_convex(int cell)
{
    fail("cut_by_walls: cell", std::to_string(cell),
        "must be convex; move its sphere or the adjacent spheres");
}

/// Edges of a rim one after the other.
std::vector<int> chained(std::vector<Segment>& rim, int cell)
{
    std::vector<int> corners;
    std::sort(rim.begin(), rim.end());
    const int start = rim.front().first;
    int at = start;
    do {
        corners.push_back(at);
        const auto next = std::lower_bound(rim.begin(), rim.end(), Segment(at, -1));
        if (next == rim.end() || next->first != at || corners.size() > rim.size())
            fail_not_convex(cell);
        at = next->second;
    } while (at != start);
    if (corners.size() != rim.size() || rim.size() < 3) fail_not_convex(cell);
    return corners;
}

class Cut {
public:
    Cut(CellComplex& c, const Wall& w, int n, double close_) :
        complex(c),
        wall(w),
        number(n),
        close(close_),
        rims(c.cells)
    {
    }

    void run()
    {
        beyond.reserve(complex.vertices.size());
        for (const Vector& p : complex.vertices)
            beyond.push_back(dot(wall.normal, p) - wall.offset);
        std::vector<CellFace> kept;
        kept.reserve(complex.faces.size());
        for (CellFace& face : complex.faces)
            if (cut_face(face)) kept.push_back(std::move(face));
        complex.faces = std::move(kept);
        for (int cell = 0; cell < complex.cells; ++cell)
            if (!rims[cell].empty()) add_wall_face(cell);
    }

private:
    CellComplex& complex;
    const Wall& wall;
    int number;
    double close;
    std::vector<double> beyond;  ///< distance of each vertex outside the wall
    std::unordered_map<std::uint64_t, int> crossings;
    std::vector<std::vector<Segment>> rims;  ///< per cell, edges of its face on the wall

    bool is_inside(int v) const { return beyond[v] <= close; }

    /// Cut a face; false if nothing of it is left.
    bool cut_face(CellFace& face)
    {
        const auto& old = face.corners;
        const auto inside =
            std::count_if(old.begin(), old.end(), [&](int v) { return is_inside(v); });
        if (inside == static_cast<std::ptrdiff_t>(old.size())) return true;
        if (inside == 0) return false;
        std::vector<int> corners;
        int leave = -1, enter = -1;
        for (std::size_t k = 0; k < old.size(); ++k) {
            const int u = old[k], v = old[(k + 1) % old.size()];
            if (is_inside(u)) corners.push_back(u);
            if (is_inside(u) == is_inside(v)) continue;
            int& end = is_inside(u) ? leave : enter;
            if (end >= 0) fail_not_convex(face.first);
            end = crossing(u, v);
            corners.push_back(end);
        }
        rims[face.first].emplace_back(enter, leave);
        if (face.second >= 0) rims[face.second].emplace_back(leave, enter);
        face.corners = std::move(corners);
        return true;
    }

    /// The vertex where an edge crosses the wall.
    int crossing(int u, int v)
    {
        const int a = std::min(u, v), b = std::max(u, v);
        const std::uint64_t key = (static_cast<std::uint64_t>(a) << 32) | static_cast<unsigned>(b);
        const auto [at, added] =
            crossings.try_emplace(key, static_cast<int>(complex.vertices.size()));
        if (!added) return at->second;
        const double share = std::clamp(beyond[a] / (beyond[a] - beyond[b]), 0.0, 1.0);
        const Vector p = complex.vertices[a] + share * (complex.vertices[b] - complex.vertices[a]);
        complex.vertices.push_back(p + (wall.offset - dot(wall.normal, p)) * wall.normal);
        std::vector<int> common;
        std::set_intersection(complex.walls[a].begin(), complex.walls[a].end(),
            complex.walls[b].begin(), complex.walls[b].end(), std::back_inserter(common));
        common.push_back(number);  // the largest so far
        complex.walls.push_back(std::move(common));
        return at->second;
    }

    void add_wall_face(int cell)
    {
        complex.faces.push_back({ cell, -1, number, chained(rims[cell], cell) });
    }
};

}  // namespace

void cut_by_walls(CellComplex& complex, const Solid& solid, double close)
{
    for (std::size_t k = 0; k < solid.walls.size(); ++k)
        Cut(complex, solid.walls[k], static_cast<int>(k), close).run();
}

}  // namespace flexpm
