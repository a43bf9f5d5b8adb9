// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Queue of edges by length; each collapse is tried on copies of the faces that it touches.
#include <flexpm/kernel/space/short_edges.hpp>

#include <flexpm/kernel/space/face_points.hpp>
#include <flexpm/kernel/space/face_triangles.hpp>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace flexpm {
namespace {

/// Share of the threshold below which edges are collapsed first.
constexpr double noise = 1e-3;
/// Smallest angle between sides of a tetrahedron that a collapse may make, as its cosine: 2
/// degrees.
constexpr double cosine_limit = 0.99939082701909573;
/// Cosine of that angle, 0.08 degrees, of tetrahedra that are flat: in cells with holes none may
/// become flat.
constexpr double flat_cosine = 1.0 - 1e-6;

/// Sine of the smallest angle of planes that meet in a line or point to which a vertex is moved.
constexpr double least_sine = 0.05;

class Collapser {
public:
    Collapser(CellComplex& c, const std::vector<Vector>& centres_, double threshold_) :
        complex(c),
        centres(centres_),
        threshold(threshold_),
        faces_at(c.vertices.size()),
        faces_of(c.cells, 0)
    {
        for (std::size_t f = 0; f < c.faces.size(); ++f) {
            const CellFace& face = c.faces[f];
            for (int v : face.corners)
                faces_at[v].push_back(static_cast<int>(f));
            count(face, 1);
        }
    }

    int run()
    {
        // corners that many cells share, but for the noise of their spheres
        limit = noise * threshold;
        collapse_all();
        limit = threshold;
        flatten_joints();
        collapse_all();
        flatten_joints();
        collapse_all();
        auto& faces = complex.faces;
        faces.erase(std::remove_if(faces.begin(), faces.end(),
                        [](const CellFace& face) { return face.corners.empty(); }),
            faces.end());
        return count_short_edges();
    }

private:
    /// The collapse of one edge.
    struct Collapse {
        int kept, lost;
        std::vector<int> touched;               ///< faces with one of the two vertices
        std::vector<std::vector<int>> corners;  ///< of each of them, empty if it goes
    };

    CellComplex& complex;
    const std::vector<Vector>& centres;
    double threshold;
    double limit = 0.0;                      ///< of the edges that are collapsed now
    bool flattens = false;                   ///< whether corners move into planes: none may turn
    bool any = false;                        ///< whether anything has changed in this round
    std::vector<std::vector<int>> faces_at;  ///< faces that meet in a vertex, in order
    std::vector<int> faces_of;               ///< number of faces of each cell
    std::set<std::tuple<double, int, int>> queue;  ///< (length, smaller vertex, larger vertex)

    void collapse_all()
    {
        // what is refused at first may go once others have gone
        do {
            any = false;
            for (const CellFace& face : complex.faces)
                offer_edges(face.corners);
            while (!queue.empty()) {
                const auto [length_then, u, v] = *queue.begin();
                queue.erase(queue.begin());
                if (is_edge(u, v) && length(u, v) == length_then) collapse(u, v);
            }
        } while (any);
    }

    /// Move corners of joints into the planes of their joints where the shapes of cells allow it:
    /// to a corner in the plane at the other end of an edge, or else to the nearest point.
    void flatten_joints()
    {
        if (complex.planes.empty()) return;
        flattens = true;
        do {
            any = false;
            std::vector<std::pair<int, int>> off;  // vertex, wall
            for (const CellFace& face : complex.faces) {
                if (face.joint < 0) continue;
                const int wall = complex.first_joint + face.joint;
                for (std::size_t k = 0; k < face.corners.size(); ++k) {
                    const int a = face.corners[k], b = face.corners[(k + 1) % face.corners.size()];
                    if (!is_on(a, wall)) off.emplace_back(a, wall);
                    if (is_on(a, wall) != is_on(b, wall))
                        queue.emplace(length(a, b), std::min(a, b), std::max(a, b));
                }
            }
            while (!queue.empty()) {
                const auto [length_then, u, v] = *queue.begin();
                queue.erase(queue.begin());
                if (is_edge(u, v) && length(u, v) == length_then) collapse(u, v);
            }
            std::sort(off.begin(), off.end());
            off.erase(std::unique(off.begin(), off.end()), off.end());
            for (const auto& [v, wall] : off)
                if (!faces_at[v].empty()) move_onto(v, wall);
            if (!any) move_together(off);
        } while (any);
        flattens = false;
    }

    bool is_on(int v, int wall) const
    {
        const auto& walls = complex.walls[v];
        return std::binary_search(walls.begin(), walls.end(), wall);
    }

    /// Move a vertex to the nearest point of its walls on one more.
    void move_onto(int v, int wall)
    {
        auto& walls = complex.walls[v];
        std::vector<int> all = walls;
        all.insert(std::lower_bound(all.begin(), all.end(), wall), wall);
        std::vector<Vector> targets(1);
        if (!is_point_on(all, complex.vertices[v], targets[0])) return;
        Collapse c { v, v, faces_at[v], {} };
        Vector sum;
        int count = 0;
        for (int f : c.touched) {
            const auto& corners = complex.faces[f].corners;
            c.corners.push_back(corners);
            const auto at = std::find(corners.begin(), corners.end(), v) - corners.begin();
            const int next = corners[(at + 1) % corners.size()];
            if (!is_subset(all, complex.walls[next])) continue;
            sum = sum + complex.vertices[next];
            ++count;
        }
        if (count > 0) targets.push_back((1.0 / count) * sum);
        for (Vector target : targets) {
            if (!keeps_shape(c, target)) continue;
            walls = std::move(all);
            any = true;
            return;
        }
    }

    /// Move vertices that share faces of a joint onto its wall simultaneously: single moves may turn
    /// tetrahedra that the move of all of them keeps.
    void move_together(const std::vector<std::pair<int, int>>& off)
    {
        std::set<std::pair<int, int>> left(off.begin(), off.end());
        while (!left.empty()) {
            const int wall = left.begin()->second;
            std::vector<int> group { left.begin()->first };
            left.erase(left.begin());
            for (std::size_t k = 0; k < group.size(); ++k)
                for (int f : faces_at[group[k]]) {
                    const CellFace& face = complex.faces[f];
                    if (complex.first_joint + face.joint != wall || face.joint < 0) continue;
                    for (int v : face.corners)
                        if (left.erase({ v, wall }) > 0) group.push_back(v);
                }
            if (group.size() > 1) move_group(group, wall);
        }
    }

    void move_group(const std::vector<int>& group, int wall)
    {
        std::vector<Vector> before, targets(group.size());
        std::vector<std::vector<int>> walls;
        std::set<int> touched;
        for (std::size_t k = 0; k < group.size(); ++k) {
            const int v = group[k];
            walls.push_back(complex.walls[v]);
            walls[k].insert(std::lower_bound(walls[k].begin(), walls[k].end(), wall), wall);
            if (!is_point_on(walls[k], complex.vertices[v], targets[k])) return;
            before.push_back(complex.vertices[v]);
            touched.insert(faces_at[v].begin(), faces_at[v].end());
        }
        const auto worst = [&] {
            double found = cosine_limit;
            for (int f : touched)
                found = std::max(found, sharpest(complex.faces[f], complex.faces[f].corners));
            return found;
        };
        const double allowed = worst();
        for (std::size_t k = 0; k < group.size(); ++k)
            complex.vertices[group[k]] = targets[k];
        const bool moved = worst() <= std::min(allowed, flattest())
            && std::all_of(touched.begin(), touched.end(), [&](int f) {
                   return !complex.has_holes || complex.faces[f].second < 0
                       || has_room(complex.faces[f].corners);
               });
        any = any || moved;
        for (std::size_t k = 0; k < group.size(); ++k) {
            if (moved)
                complex.walls[group[k]] = walls[k];
            else
                complex.vertices[group[k]] = before[k];
        }
    }

    /// Find the point on planes that is nearest to another one; false if there is none.
    bool is_point_on(const std::vector<int>& walls, Vector from, Vector& found) const
    {
        // directions in which the point may move, made orthogonal to the planes before
        std::vector<Vector> axes;
        found = from;
        for (int wall : walls) {
            const WallPlane& plane = complex.planes[wall];
            Vector axis = plane.normal;
            for (const Vector& before : axes)
                axis = axis - dot(axis, before) * before;
            const double size = norm(axis);
            if (axes.size() == 3 || size < least_sine) return false;
            axis = (1.0 / size) * axis;
            found = found + ((plane.offset - dot(plane.normal, found)) / size) * axis;
            axes.push_back(axis);
        }
        return true;
    }

    double length(int u, int v) const { return norm(complex.vertices[v] - complex.vertices[u]); }

    void count(const CellFace& face, int change)
    {
        faces_of[face.first] += change;
        if (face.second >= 0) faces_of[face.second] += change;
    }

    void offer_edges(const std::vector<int>& corners)
    {
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const int a = corners[k], b = corners[(k + 1) % corners.size()];
            const double l = length(a, b);
            if (l < limit) queue.emplace(l, std::min(a, b), std::max(a, b));
        }
    }

    bool is_edge(int u, int v) const
    {
        for (int f : faces_at[u]) {
            const auto& corners = complex.faces[f].corners;
            for (std::size_t k = 0; k < corners.size(); ++k) {
                const int a = corners[k], b = corners[(k + 1) % corners.size()];
                if ((a == u && b == v) || (a == v && b == u)) return true;
            }
        }
        return false;
    }

    void collapse(int u, int v)
    {
        const auto &of_u = complex.walls[u], &of_v = complex.walls[v];
        const bool u_fits = is_subset(of_u, of_v), v_fits = is_subset(of_v, of_u);
        if (!u_fits && !v_fits) return;
        Collapse c;
        c.kept = u_fits ? v : u;
        c.lost = c.kept == u ? v : u;
        std::set_union(faces_at[u].begin(), faces_at[u].end(), faces_at[v].begin(),
            faces_at[v].end(), std::back_inserter(c.touched));
        for (int f : c.touched)
            c.corners.push_back(merged(complex.faces[f].corners, c.kept, c.lost));
        if (!keeps_cells(c)) return;
        const Vector at_u = complex.vertices[u], at_v = complex.vertices[v];
        std::vector<Vector> targets { complex.vertices[c.kept] };
        if (u_fits && v_fits) targets = { 0.5 * (at_u + at_v), at_u, at_v };
        for (Vector target : targets) {
            if (!keeps_shape(c, target)) continue;
            apply(c);
            break;
        }
    }

    /// The corners with `lost` replaced by `kept`, empty if fewer than three are left.
    static std::vector<int> merged(const std::vector<int>& corners, int kept, int lost)
    {
        std::vector<int> result;
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const int a = corners[k], b = corners[(k + 1) % corners.size()];
            if ((a == kept && b == lost) || (a == lost && b == kept)) continue;
            result.push_back(a == lost ? kept : a);
        }
        return result.size() < 3 ? std::vector<int> {} : result;
    }

    /// Whether polygons stay simple, cells keep four faces, and edges two faces of each cell.
    bool keeps_cells(const Collapse& c) const
    {
        std::map<int, int> left;                 // faces of each cell
        std::vector<std::pair<int, int>> edges;  // cell, vertex to which an edge leads from `kept`
        for (std::size_t k = 0; k < c.touched.size(); ++k) {
            const CellFace& face = complex.faces[c.touched[k]];
            const auto& corners = c.corners[k];
            for (int cell : { face.first, face.second })
                if (cell >= 0)
                    left.try_emplace(cell, faces_of[cell]).first->second -= corners.empty();
            const std::size_t n = corners.size();
            if (std::count(corners.begin(), corners.end(), c.kept) > 1) return false;
            for (std::size_t i = 0; i < n; ++i) {
                if (corners[i] != c.kept) continue;
                edges.emplace_back(face.first, corners[(i + 1) % n]);
                if (face.second >= 0) edges.emplace_back(face.second, corners[(i + n - 1) % n]);
            }
        }
        for (const auto& [cell, faces] : left)
            if (faces < 4) return false;
        std::sort(edges.begin(), edges.end());
        return std::adjacent_find(edges.begin(), edges.end()) == edges.end();
    }

    /// Whether no tetrahedron becomes too sharp: then `kept` is moved to the target.
    bool keeps_shape(const Collapse& c, Vector target)
    {
        if (limit < threshold) {  // by less than noise, the shape does not change
            complex.vertices[c.kept] = target;
            return true;
        }
        double before = cosine_limit, after = -1.0;
        for (int f : c.touched)
            before = std::max(before, sharpest(complex.faces[f], complex.faces[f].corners));
        std::vector<int> roomy;  // faces that must keep their space
        for (std::size_t k = 0; k < c.touched.size(); ++k) {
            const CellFace& face = complex.faces[c.touched[k]];
            const bool looks = face.second >= 0 && complex.has_holes;
            if (looks && (flattens || has_room(face.corners))) roomy.push_back(static_cast<int>(k));
        }
        const Vector at = std::exchange(complex.vertices[c.kept], target);
        for (std::size_t k = 0; k < c.touched.size(); ++k)
            after = std::max(after, sharpest(complex.faces[c.touched[k]], c.corners[k]));
        const bool kept = after <= before && (!flattens || after <= flattest())
            && std::all_of(
                roomy.begin(), roomy.end(), [&](int k) { return has_room(c.corners[k]); });
        if (!kept) complex.vertices[c.kept] = at;
        return kept;
    }

    /// Cosine of the smallest angle that a move may leave.
    double flattest() const { return complex.has_holes ? flat_cosine : 1.0; }

    /// Whether a contact has space for its points, which a polygon that has become concave lacks.
    bool has_room(const std::vector<int>& corners) const
    {
        if (corners.empty()) return true;
        std::vector<Vector> places;
        for (int v : corners)
            places.push_back(complex.vertices[v]);
        return has_points(places);
    }

    /// Cosine of the smallest angle of the tetrahedra on a face.
    double sharpest(const CellFace& face, const std::vector<int>& corners) const
    {
        double result = -1.0;
        if (corners.empty()) return result;
        for (const auto& [a, b, c] : face_triangles(complex.vertices, corners)) {
            const Vector p = complex.vertices[a], q = complex.vertices[b], r = complex.vertices[c];
            double worst = sharpest_cosine(centres[face.first], p, q, r);
            if (face.second >= 0)
                worst = std::max(worst, sharpest_cosine(centres[face.second], p, r, q));
            const bool is_short = std::min({ length(a, b), length(b, c), length(c, a) }) < limit;
            if (!is_short || worst > flattest()) result = std::max(result, worst);
        }
        return result;
    }

    void apply(const Collapse& c)
    {
        any = true;
        std::vector<int> left;
        for (std::size_t k = 0; k < c.touched.size(); ++k) {
            const int f = c.touched[k];
            auto& corners = complex.faces[f].corners;
            if (c.corners[k].empty()) {
                count(complex.faces[f], -1);
                for (int v : corners)
                    if (v != c.kept && v != c.lost) erase_value(faces_at[v], f);
            } else {
                left.push_back(f);
            }
            corners = c.corners[k];
        }
        faces_at[c.kept] = std::move(left);
        faces_at[c.lost].clear();
        for (int f : faces_at[c.kept])
            offer_edges_at(c.kept, complex.faces[f].corners);
    }

    static void erase_value(std::vector<int>& values, int value)
    {
        values.erase(std::find(values.begin(), values.end(), value));
    }

    void offer_edges_at(int vertex, const std::vector<int>& corners)
    {
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const int a = corners[k], b = corners[(k + 1) % corners.size()];
            if (a == vertex || b == vertex) offer_edges({ a, b });
        }
    }

    int count_short_edges() const
    {
        std::set<std::pair<int, int>> edges;
        for (const CellFace& face : complex.faces)
            for (std::size_t k = 0; k < face.corners.size(); ++k) {
                const int a = face.corners[k], b = face.corners[(k + 1) % face.corners.size()];
                if (length(a, b) < threshold) edges.emplace(std::min(a, b), std::max(a, b));
            }
        return static_cast<int>(edges.size());
    }
};

}  // namespace

int collapse_short_edges(CellComplex& complex, const std::vector<Vector>& centres, double threshold)
{
    return Collapser(complex, centres, threshold).run();
}

}  // namespace flexpm
