// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Measures of cells, and vertices that are one to round-off.
#include <flexpm/kernel/space/cell_complex.hpp>

#include <algorithm>
#include <numeric>
#include <set>

namespace flexpm {
namespace {

/// Vertices that have become one, each group under its representative.
class Groups {
public:
    explicit Groups(std::size_t vertices) : parents(vertices)
    {
        std::iota(parents.begin(), parents.end(), 0);
    }

    int of(int v)
    {
        while (parents[v] != v)
            v = parents[v] = parents[parents[v]];
        return v;
    }

    void join(int lost, int kept) { parents[lost] = kept; }

private:
    std::vector<int> parents;
};

class Merger {
public:
    Merger(CellComplex& c, double d) : complex(c), distance(d), groups(c.vertices.size()) { }

    void run()
    {
        for (const CellFace& face : complex.faces)
            for (std::size_t k = 0; k < face.corners.size(); ++k)
                merge_short(face.corners[k], face.corners[(k + 1) % face.corners.size()]);
        rename();
        while (cut_narrow_faces())
            rename();
        straighten();
    }

private:
    CellComplex& complex;
    double distance;
    Groups groups;

    double length(int u, int v) const { return norm(complex.vertices[v] - complex.vertices[u]); }

    void merge_short(int u, int v)
    {
        u = groups.of(u);
        v = groups.of(v);
        if (u != v && length(u, v) < distance) merge(u, v);
    }

    bool merge(int u, int v)
    {
        const auto &of_u = complex.walls[u], &of_v = complex.walls[v];
        const bool u_fits = is_subset(of_u, of_v), v_fits = is_subset(of_v, of_u);
        if (u_fits && v_fits)
            groups.join(std::max(u, v), std::min(u, v));
        else if (u_fits)
            groups.join(u, v);
        else if (v_fits)
            groups.join(v, u);
        return u_fits || v_fits;
    }

    /// Put representatives into the faces; faces that have fewer than three go.
    void rename()
    {
        for (CellFace& face : complex.faces) {
            auto& corners = face.corners;
            for (int& v : corners)
                v = groups.of(v);
            corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
            while (corners.size() > 1 && corners.front() == corners.back())
                corners.pop_back();
        }
        const auto gone = std::remove_if(complex.faces.begin(), complex.faces.end(),
            [](const CellFace& face) { return face.corners.size() < 3; });
        complex.faces.erase(gone, complex.faces.end());
    }

    /// Merge the ends of the shortest edge of each narrow face: other corners lie on a line between
    /// them.
    bool cut_narrow_faces()
    {
        bool any = false;
        for (const CellFace& face : complex.faces) {
            const auto& corners = face.corners;
            double around = 0.0, shortest = -1.0;
            int u = -1, v = -1;
            for (std::size_t k = 0; k < corners.size(); ++k) {
                const int a = corners[k], b = corners[(k + 1) % corners.size()];
                const double along = length(a, b);
                around += along;
                if (shortest >= 0.0 && along >= shortest) continue;
                shortest = along;
                u = groups.of(a);
                v = groups.of(b);
            }
            if (2.0 * norm(area_vector(complex, corners)) > distance * around) continue;
            any = (u != v && merge(u, v)) || any;
        }
        return any;
    }

    /// Take vertices out that only two edges meet in, which lie on a straight line.
    void straighten()
    {
        std::vector<std::set<int>> neighbours(complex.vertices.size());
        for (const CellFace& face : complex.faces)
            for (std::size_t k = 0; k < face.corners.size(); ++k) {
                const int u = face.corners[k], v = face.corners[(k + 1) % face.corners.size()];
                neighbours[u].insert(v);
                neighbours[v].insert(u);
            }
        for (CellFace& face : complex.faces) {
            auto& corners = face.corners;
            corners.erase(std::remove_if(corners.begin(), corners.end(),
                              [&](int v) { return neighbours[v].size() == 2; }),
                corners.end());
        }
    }
};

}  // namespace

bool is_subset(const std::vector<int>& some, const std::vector<int>& all)
{
    return std::includes(all.begin(), all.end(), some.begin(), some.end());
}

Vector area_vector(const CellComplex& complex, const std::vector<int>& corners)
{
    const Vector origin = complex.vertices[corners[0]];
    Vector twice;
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
        twice = twice
            + cross(
                complex.vertices[corners[k]] - origin, complex.vertices[corners[k + 1]] - origin);
    }
    return 0.5 * twice;
}

std::vector<double> cell_volumes(const CellComplex& complex)
{
    // relative to a corner of the cell, so that no digits are lost far from the origin
    std::vector<int> origins(complex.cells, -1);
    std::vector<double> volumes(complex.cells, 0.0);
    const auto add = [&](int cell, const CellFace& face, double sign) {
        if (origins[cell] < 0) origins[cell] = face.corners[0];
        const Vector origin = complex.vertices[origins[cell]];
        const Vector a = complex.vertices[face.corners[0]] - origin;
        for (std::size_t k = 1; k + 1 < face.corners.size(); ++k) {
            volumes[cell] += sign / 6.0
                * triple(a, complex.vertices[face.corners[k]] - origin,
                    complex.vertices[face.corners[k + 1]] - origin);
        }
    };
    for (const CellFace& face : complex.faces) {
        add(face.first, face, 1.0);
        if (face.second >= 0) add(face.second, face, -1.0);
    }
    return volumes;
}

std::vector<Vector> cell_centroids(const CellComplex& complex, const std::vector<Vector>& origins,
    const std::vector<double>& volumes)
{
    std::vector<Vector> moments(complex.cells);
    const auto add = [&](int cell, const CellFace& face, double sign) {
        const Vector origin = origins[cell];
        const Vector a = complex.vertices[face.corners[0]] - origin;
        for (std::size_t k = 1; k + 1 < face.corners.size(); ++k) {
            const Vector b = complex.vertices[face.corners[k]] - origin;
            const Vector c = complex.vertices[face.corners[k + 1]] - origin;
            moments[cell] = moments[cell] + (sign / 24.0 * triple(a, b, c)) * (a + b + c);
        }
    };
    for (const CellFace& face : complex.faces) {
        add(face.first, face, 1.0);
        if (face.second >= 0) add(face.second, face, -1.0);
    }
    for (int c = 0; c < complex.cells; ++c)
        moments[c] = origins[c] + (volumes[c] > 0.0 ? 1.0 / volumes[c] : 0.0) * moments[c];
    return moments;
}

int count_contacts(const CellComplex& complex)
{
    return static_cast<int>(std::count_if(complex.faces.begin(), complex.faces.end(),
        [](const CellFace& face) { return face.second >= 0; }));
}

void merge_close_vertices(CellComplex& complex, double distance)
{
    Merger(complex, distance).run();
}

}  // namespace flexpm
