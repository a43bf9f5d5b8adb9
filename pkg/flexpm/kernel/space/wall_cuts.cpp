// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Half-space by half-space; the rims of the cuts are chained to the faces on the wall.
/// A notch keeps both halves of what it cuts.
#include <flexpm/kernel/space/wall_cuts.hpp>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
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

/// The part of a notch that a cell may have.
struct Piece {
    double depth = 0.0;   ///< largest distance of a vertex from the plane
    double volume = 0.0;  ///< of the piece
};

class Notch {
public:
    Notch(CellComplex& c, const NotchCut& n) :
        complex(c),
        notch(n),
        right_of(c.cells, -1),
        side(c.cells, 0),
        passed(c.cells, false),
        rims(c.cells)
    {
        for (const Vector& p : complex.vertices)
            beyond.push_back(p.x - notch.x);
    }

    std::vector<int> run()
    {
        choose();
        std::vector<int> sources;
        for (int cell = 0; cell < old_cells; ++cell) {
            if (right_of[cell] < 0) continue;
            right_of[cell] = complex.cells++;
            sources.push_back(cell);
        }
        split_faces();
        insert_crossings();
        open_faces();
        for (int cell = 0; cell < old_cells; ++cell)
            if (right_of[cell] >= 0) add_flanks(cell);
        return sources;
    }

private:
    CellComplex& complex;
    const NotchCut& notch;
    const int old_cells = complex.cells;
    std::vector<double> beyond;  ///< distance of each vertex to the right of the plane
    std::vector<int> right_of;   ///< per old cell: its right piece, -1 if it is not cut
    std::vector<int> side;       ///< per cell: -1 left, 1 right, 0 it bridges the plane
    std::vector<bool> passed;    ///< per cell: the plane passes it below the front
    std::unordered_map<std::uint64_t, int> crossings;
    std::vector<std::vector<Segment>> rims;  ///< per old cell, edges of its section, for the left

    bool is_right(int v) const { return beyond[v] > notch.close; }
    double height(Vector p) const { return notch.from_above ? -p.z : p.z; }

    static std::uint64_t key(int u, int v)
    {
        const int a = std::min(u, v), b = std::max(u, v);
        return (static_cast<std::uint64_t>(a) << 32) | static_cast<unsigned>(b);
    }

    Vector place_between(int u, int v) const
    {
        const int a = std::min(u, v), b = std::max(u, v);
        const double share = std::clamp(beyond[a] / (beyond[a] - beyond[b]), 0.0, 1.0);
        Vector p = complex.vertices[a] + share * (complex.vertices[b] - complex.vertices[a]);
        p.x = notch.x;
        return p;
    }

    int crossing(int u, int v)
    {
        const auto [at, added] =
            crossings.try_emplace(key(u, v), static_cast<int>(complex.vertices.size()));
        if (!added) return at->second;
        const int a = std::min(u, v), b = std::max(u, v);
        complex.vertices.push_back(place_between(u, v));
        std::vector<int> common;
        std::set_intersection(complex.walls[a].begin(), complex.walls[a].end(),
            complex.walls[b].begin(), complex.walls[b].end(), std::back_inserter(common));
        common.push_back(notch.wall);  // the largest of all
        complex.walls.push_back(std::move(common));
        beyond.push_back(0.0);
        return at->second;
    }

    /// Part of a polygon on one side, as places.
    std::vector<Vector> clipped(const std::vector<int>& corners, bool right) const
    {
        std::vector<Vector> part;
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const int u = corners[k], v = corners[(k + 1) % corners.size()];
            if (is_right(u) == right) part.push_back(complex.vertices[u]);
            if (is_right(u) != is_right(v)) part.push_back(place_between(u, v));
        }
        return part;
    }

    /// Six times the volume between a polygon and an origin.
    static double cone(const std::vector<Vector>& polygon, Vector origin)
    {
        double sum = 0.0;
        for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
            sum += triple(polygon[0] - origin, polygon[k] - origin, polygon[k + 1] - origin);
        return sum;
    }

    /// Area of a section below a height, over twice; the section is the sum of its rim's edges seen
    /// from any point, of which those above the height have none.
    double twice_area(const std::vector<std::pair<Vector, Vector>>& rim, double top) const
    {
        // strips below the rim's edges: integral of min(height, top) dy
        double sum = 0.0;
        for (const auto& [a, b] : rim) {
            const double low = height(a), high = height(b);
            const double from = std::min(low, top), to = std::min(high, top), way = b.y - a.y;
            if ((low > top) == (high > top) || low == high) {
                sum += (from + to) * way;
                continue;
            }
            const double part = std::clamp((top - low) / (high - low), 0.0, 1.0) * way;
            sum += (from + top) * part + (top + to) * (way - part);
        }
        return std::fabs(sum);
    }

    /// Decide what becomes of each cell.
    void choose()
    {
        std::vector<std::vector<std::size_t>> faces_of(old_cells);
        for (std::size_t f = 0; f < complex.faces.size(); ++f) {
            faces_of[complex.faces[f].first].push_back(f);
            if (complex.faces[f].second >= 0) faces_of[complex.faces[f].second].push_back(f);
        }
        for (int cell = 0; cell < old_cells; ++cell)
            choose(cell, faces_of[cell]);
    }

    void choose(int cell, const std::vector<std::size_t>& faces)
    {
        Piece left, right;
        for (std::size_t f : faces)
            for (int v : complex.faces[f].corners) {
                Piece& of = is_right(v) ? right : left;
                of.depth = std::max(of.depth, std::fabs(beyond[v]));
            }
        if (!(left.depth > notch.close && right.depth > notch.close)) {
            side[cell] = right.depth > left.depth ? 1 : -1;
            return;
        }
        std::vector<std::pair<Vector, Vector>> rim;
        for (std::size_t f : faces) {
            Vector ends[2];
            if (!section_edge(complex.faces[f].corners, ends)) continue;
            const bool turned = complex.faces[f].second == cell;
            rim.emplace_back(ends[turned], ends[!turned]);
        }
        const double all = twice_area(rim, std::numeric_limits<double>::infinity());
        if (!(all > 0.0 && twice_area(rim, notch.top) >= 0.5 * all)) return;
        passed[cell] = true;
        for (std::size_t f : faces) {
            const double sign = complex.faces[f].second == cell ? -1.0 : 1.0;
            const auto& corners = complex.faces[f].corners;
            left.volume += sign / 6.0 * cone(clipped(corners, false), rim.front().first);
            right.volume += sign / 6.0 * cone(clipped(corners, true), rim.front().first);
        }
        const bool sound = std::min(left.depth, right.depth) >= notch.least_depth
            && std::min(left.volume, right.volume) >= notch.least_volume;
        side[cell] = sound || left.volume >= right.volume ? -1 : 1;
        if (sound) right_of[cell] = cell;  // numbered once all are known
    }

    /// Where a face enters and leaves the left side; false if it does not cross the plane.
    bool section_edge(const std::vector<int>& corners, Vector (&ends)[2]) const
    {
        int found = 0;
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const int u = corners[k], v = corners[(k + 1) % corners.size()];
            if (is_right(u) == is_right(v)) continue;
            ends[is_right(u) ? 0 : 1] = place_between(u, v);
            ++found;
        }
        return found == 2;
    }

    int piece_of(int cell, bool right) const
    {
        return right && cell >= 0 && right_of[cell] >= 0 ? right_of[cell] : cell;
    }
    bool is_cut(int cell) const { return cell >= 0 && right_of[cell] >= 0; }

    /// Faces of cells that are cut belong to a piece, or are cut themselves.
    void split_faces()
    {
        std::vector<CellFace> added;
        for (CellFace& face : complex.faces) {
            if (!is_cut(face.first) && !is_cut(face.second)) continue;
            const auto rights = std::count_if(
                face.corners.begin(), face.corners.end(), [&](int v) { return is_right(v); });
            const bool whole =
                rights == 0 || rights == static_cast<std::ptrdiff_t>(face.corners.size());
            CellFace other { piece_of(face.first, true), piece_of(face.second, true), face.wall,
                {} };
            if (whole) {
                if (rights > 0) {
                    face.first = other.first;
                    face.second = other.second;
                }
                continue;
            }
            std::vector<int> corners;
            int enter = -1, leave = -1;
            for (std::size_t k = 0; k < face.corners.size(); ++k) {
                const int u = face.corners[k], v = face.corners[(k + 1) % face.corners.size()];
                (is_right(u) ? other.corners : corners).push_back(u);
                if (is_right(u) == is_right(v)) continue;
                int& end = is_right(u) ? enter : leave;
                if (end >= 0) fail_not_convex(face.first);
                end = crossing(u, v);
                corners.push_back(end);
                other.corners.push_back(end);
            }
            if (is_cut(face.first)) rims[face.first].emplace_back(enter, leave);
            if (is_cut(face.second)) rims[face.second].emplace_back(leave, enter);
            face.corners = std::move(corners);
            order(other);
            added.push_back(std::move(other));
        }
        for (CellFace& face : complex.faces)
            order(face);
        complex.faces.insert(complex.faces.end(), std::make_move_iterator(added.begin()),
            std::make_move_iterator(added.end()));
        side.resize(complex.cells, 1);
        passed.resize(complex.cells, true);
    }

    /// The lower number first, as numbered cells have it.
    static void order(CellFace& face)
    {
        if (face.second < 0 || face.first < face.second) return;
        std::swap(face.first, face.second);
        std::reverse(face.corners.begin(), face.corners.end());
    }

    /// Edges that are divided have their new vertex in all faces.
    void insert_crossings()
    {
        for (CellFace& face : complex.faces) {
            std::vector<int> corners;
            for (std::size_t k = 0; k < face.corners.size(); ++k) {
                const int u = face.corners[k], v = face.corners[(k + 1) % face.corners.size()];
                corners.push_back(u);
                const auto found = crossings.find(key(u, v));
                if (found != crossings.end()) corners.push_back(found->second);
            }
            face.corners = std::move(corners);
        }
    }

    double height_of(const CellFace& face) const
    {
        double sum = 0.0;
        for (int v : face.corners)
            sum += height(complex.vertices[v]);
        return sum / static_cast<double>(face.corners.size());
    }

    void open_faces()
    {
        std::vector<CellFace> opened;
        for (CellFace& face : complex.faces) {
            if (face.second < 0 || side[face.first] * side[face.second] != -1) continue;
            if (!passed[face.first] && !passed[face.second] && height_of(face) >= notch.top)
                continue;
            CellFace other { face.second, -1, notch.wall, face.corners };
            std::reverse(other.corners.begin(), other.corners.end());
            opened.push_back(std::move(other));
            face.second = -1;
            face.wall = notch.wall;
        }
        complex.faces.insert(complex.faces.end(), std::make_move_iterator(opened.begin()),
            std::make_move_iterator(opened.end()));
    }

    void add_flanks(int cell)
    {
        CellFace left { cell, -1, notch.wall, chained(rims[cell], cell) };
        CellFace right { right_of[cell], -1, notch.wall, left.corners };
        std::reverse(right.corners.begin(), right.corners.end());
        complex.faces.push_back(std::move(left));
        complex.faces.push_back(std::move(right));
    }
};

}  // namespace

void cut_by_walls(CellComplex& complex, const Solid& solid, double close)
{
    for (std::size_t k = 0; k < solid.walls.size(); ++k)
        Cut(complex, solid.walls[k], static_cast<int>(k), close).run();
}

std::vector<int> cut_by_notch(CellComplex& complex, const NotchCut& notch)
{
    return Notch(complex, notch).run();
}

}  // namespace flexpm
