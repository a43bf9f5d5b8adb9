// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Numbers are checked first, then edges, planes and volumes.
#include <flexpm/kernel/space/own_polyhedra.hpp>

#include <flexpm/kernel/space/sphere_checks.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <tuple>
#include <utility>

namespace flexpm {
namespace {

/// Distance over the mean diameter up to which a face is plane, an edge convex, a corner on a wall.
constexpr double out_of_plane = 1e-6;
/// Share of the solid up to which cells may leave gaps or overlap.
constexpr double unfilled = 1e-6;

std::string named(const char* what, int number)
{
    return "own_polyhedra: " + std::string(what) + " " + std::to_string(number + 1);
}

/// Edge of a cell with the face whose corners follow it from `u` to `v`, or back.
struct Side {
    int cell, u, v;  ///< u < v
    bool back;
    int face;
};

class Checker {
public:
    Checker(const OwnCells& o, const Solid& s) :
        own(o),
        solid(s),
        near(out_of_plane * mean_diameter(o.spheres))
    {
    }

    /// The cells as the faces they share, vertices with the walls they lie on.
    CellComplex run()
    {
        require_numbers();
        complex.cells = static_cast<int>(own.spheres.size());
        complex.vertices = own.vertices;
        complex.walls.resize(own.vertices.size());
        for (const OwnFace& face : own.faces)
            complex.faces.push_back({ face.first, face.second, -1, face.corners });
        add_planes();
        require_pairs();
        require_closed_and_convex();
        require_filled();
        for (auto& walls : complex.walls) {
            std::sort(walls.begin(), walls.end());
            walls.erase(std::unique(walls.begin(), walls.end()), walls.end());
        }
        return std::move(complex);
    }

private:
    const OwnCells& own;
    const Solid& solid;
    double near;
    CellComplex complex;
    std::vector<Vector> areas;    ///< per face, towards outside its first cell
    std::vector<Vector> middles;  ///< per face, of its corners

    void require_numbers() const
    {
        const auto vertices = static_cast<int>(own.vertices.size());
        const auto cells = static_cast<int>(own.spheres.size());
        for (int v = 0; v < vertices; ++v)
            if (!is_finite(own.vertices[v])) {
                refuse(named("vertex", v), place(own.vertices[v]), "must be finite; correct it");
            }
        for (std::size_t f = 0; f < own.faces.size(); ++f) {
            const OwnFace& face = own.faces[f];
            const std::string name = named("face", static_cast<int>(f));
            if (face.first < 0 || face.first >= cells || face.second >= cells
                || (face.second != -1 && face.second <= face.first)) {
                refuse(name + ": cells",
                    std::to_string(face.first) + " and " + std::to_string(face.second),
                    "must be two of " + std::to_string(cells)
                        + ", the lower one first, or one and "
                          "-1");
            }
            auto sorted = face.corners;
            std::sort(sorted.begin(), sorted.end());
            if (sorted.size() < 3 || sorted.front() < 0 || sorted.back() >= vertices
                || std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
                refuse(name + ": corners", std::to_string(sorted.size()),
                    "must be three or more of " + std::to_string(vertices)
                        + " vertices, each once; correct it");
            }
        }
    }

    /// Area and middle of each face, which must be plane, and the walls of outer ones.
    void add_planes()
    {
        for (std::size_t f = 0; f < complex.faces.size(); ++f) {
            CellFace& face = complex.faces[f];
            const Vector area = area_vector(complex, face.corners);
            Vector middle;
            for (int v : face.corners)
                middle = middle + (1.0 / face.corners.size()) * complex.vertices[v];
            areas.push_back(area);
            middles.push_back(middle);
            const double size = norm(area);
            if (!(size > 0.0)) continue;  // as small as round-off: it goes when vertices are merged
            double bent = 0.0;
            for (int v : face.corners)
                bent = std::max(bent, std::abs(dot(area, complex.vertices[v] - middle)) / size);
            if (bent > near) {
                refuse(named("cell", face.first) + ", face " + std::to_string(f + 1)
                        + ": corners off its plane by",
                    bent, "m",
                    "must be <= " + number(near)
                        + " m; use cells without regularization and curved cuts");
            }
            if (face.second < 0) face.wall = wall_of(static_cast<int>(f), (1.0 / size) * area);
        }
    }

    int wall_of(int f, Vector normal)
    {
        const auto& corners = complex.faces[f].corners;
        for (std::size_t w = 0; w < solid.walls.size(); ++w) {
            const Wall& wall = solid.walls[w];
            const bool lies_on = std::all_of(corners.begin(), corners.end(), [&](int v) {
                return std::abs(dot(wall.normal, complex.vertices[v]) - wall.offset) <= near;
            });
            if (!lies_on || dot(wall.normal, normal) <= 0.0) continue;
            for (int v : corners)
                complex.walls[v].push_back(static_cast<int>(w));
            return static_cast<int>(w);
        }
        refuse(named("cell", complex.faces[f].first) + ", face " + std::to_string(f + 1)
                + ": middle of this outer face",
            place(middles[f]),
            "must lie on a side; take cells of a box along x, y, z or of an upright cylinder of 16 "
            "facets or more, not periodic");
    }

    /// Cells that touch do so in one face.
    void require_pairs() const
    {
        std::vector<std::array<int, 3>> pairs;
        for (std::size_t f = 0; f < own.faces.size(); ++f)
            if (own.faces[f].second >= 0)
                pairs.push_back({ own.faces[f].first, own.faces[f].second, static_cast<int>(f) });
        std::sort(pairs.begin(), pairs.end());
        for (std::size_t k = 1; k < pairs.size(); ++k) {
            const auto &a = pairs[k - 1], &b = pairs[k];
            if (a[0] != b[0] || a[1] != b[1]) continue;
            refuse(named("cell", a[0]) + ", face " + std::to_string(b[2] + 1) + ": cell beyond it",
                std::to_string(b[1] + 1),
                "is that of face " + std::to_string(a[2] + 1) + ", must be another; join them");
        }
    }

    void require_closed_and_convex() const
    {
        std::vector<Side> sides;
        for (std::size_t f = 0; f < own.faces.size(); ++f) {
            const OwnFace& face = own.faces[f];
            for (std::size_t k = 0; k < face.corners.size(); ++k) {
                const int u = face.corners[k], v = face.corners[(k + 1) % face.corners.size()];
                const auto [low, high] = std::minmax(u, v);
                const int number = static_cast<int>(f);
                sides.push_back({ face.first, low, high, u > v, number });
                if (face.second >= 0) sides.push_back({ face.second, low, high, u < v, number });
            }
        }
        const auto key = [](const Side& s) { return std::tie(s.cell, s.u, s.v, s.back); };
        std::sort(sides.begin(), sides.end(),
            [&](const Side& a, const Side& b) { return key(a) < key(b); });
        for (std::size_t k = 0; k < sides.size(); k += 2) {
            const Side& one = sides[k];
            const bool closed = k + 1 < sides.size() && !one.back && sides[k + 1].back
                && std::tie(one.cell, one.u, one.v)
                    == std::tie(sides[k + 1].cell, sides[k + 1].u, sides[k + 1].v);
            if (!closed) {
                refuse(named("cell", one.cell) + ", face " + std::to_string(one.face + 1)
                        + ": edge between vertices",
                    std::to_string(one.u + 1) + " and " + std::to_string(one.v + 1),
                    "must be one of two faces of the cell; close the cell");
            }
            require_convex(one, sides[k + 1].face);
        }
    }

    /// Corners of the smaller face behind the plane of the larger one, whose digits are better.
    void require_convex(const Side& edge, int other) const
    {
        int large = edge.face, small = other;
        if (norm(areas[large]) < norm(areas[small])) std::swap(large, small);
        const double size = norm(areas[large]);
        if (!(size > 0.0)) return;
        const double sign = own.faces[large].first == edge.cell ? 1.0 : -1.0;
        for (int v : own.faces[small].corners) {
            const double beyond = sign * dot(areas[large], own.vertices[v] - middles[large]) / size;
            if (beyond <= near) continue;
            refuse(named("cell", edge.cell) + ", face " + std::to_string(large + 1)
                    + ": corner of face " + std::to_string(small + 1) + " beyond it by",
                beyond, "m", "must be convex, to " + number(near) + " m; divide the cell");
        }
    }

    void require_filled() const
    {
        const auto volumes = cell_volumes(complex);
        double sum = 0.0;
        for (std::size_t c = 0; c < volumes.size(); ++c) {
            if (!(volumes[c] > 0.0))
                refuse(named("cell", static_cast<int>(c)) + ": volume", volumes[c], "m^3",
                    "must be above 0; correct its faces");
            sum += volumes[c];
        }
        if (std::abs(sum - solid.volume) <= unfilled * solid.volume) return;
        refuse("own_polyhedra: volume of all cells", sum, "m^3",
            "must be the volume of the specimen,  " + number(solid.volume)
                + " m^3; take cells of a box along x, y, z or of a cylinder");
    }
};

/// Check that each centre is inside its cell: it is a corner of all its tetrahedra.
void require_centres(const CellComplex& complex, const std::vector<Sphere>& spheres)
{
    std::vector<int> faces(spheres.size(), 0);
    for (const CellFace& face : complex.faces) {
        const Vector area = area_vector(complex, face.corners);
        const Vector at = complex.vertices[face.corners[0]];
        const auto require = [&](int cell, double sign) {
            ++faces[cell];
            if (sign * dot(area, at - spheres[cell].centre) > 0.0) return;
            refuse(named("cell", cell) + ": centre", place(spheres[cell].centre),
                "must be inside; correct its faces");
        };
        require(face.first, 1.0);
        if (face.second >= 0) require(face.second, -1.0);
    }
    for (std::size_t c = 0; c < faces.size(); ++c)
        if (faces[c] < 4) {
            refuse(named("cell", static_cast<int>(c)) + ": faces", std::to_string(faces[c]),
                "must be four or more, wider than round-off; correct it");
        }
}

void require_pores(const std::vector<int>& pores, int cells)
{
    for (std::size_t k = 0; k < pores.size(); ++k) {
        const bool is_cell = pores[k] >= 0 && pores[k] < cells;
        if (is_cell && (k == 0 || pores[k - 1] < pores[k])) continue;
        refuse("own_polyhedra: pore", std::to_string(pores[k]),
            "must be one of " + std::to_string(cells) + " cells, in order, each once; correct it");
    }
    if (static_cast<int>(pores.size()) == cells)
        refuse("own_polyhedra: pores", std::to_string(cells), "must leave a cell; take fewer");
}

void require_sizes(const std::vector<Sphere>& spheres, const Solid& solid)
{
    if (spheres.empty()) refuse("own_polyhedra: cells", 0.0, "", "must be >= 1; give a cell");
    for (std::size_t c = 0; c < spheres.size(); ++c) {
        const std::string name = named("cell", static_cast<int>(c));
        if (!is_finite(spheres[c].centre))
            refuse(name + ": centre", place(spheres[c].centre), "must be finite; correct it");
        check_positive(name + ": radius", spheres[c].radius, "m");
        // a size of its own sense: tolerances follow it
        if (spheres[c].radius > norm(solid.high - solid.low))
            refuse(name + ": radius", spheres[c].radius, "m", "must be below the solid's size");
    }
}

/// Centres of whole cells, and centroids of pieces.
std::vector<Vector> centres_of(
    const CellComplex& complex, const std::vector<Sphere>& spheres, const std::vector<int>& sources)
{
    std::vector<Vector> centres;
    for (const Sphere& sphere : spheres)
        centres.push_back(sphere.centre);
    if (sources.empty()) return centres;
    std::vector<bool> cut(spheres.size());
    for (int source : sources) {
        centres.push_back(spheres[source].centre);
        cut[source] = true;
        cut.push_back(true);
    }
    const auto centroids = cell_centroids(complex, centres, cell_volumes(complex));
    for (std::size_t c = 0; c < centres.size(); ++c)
        if (cut[c]) centres[c] = centroids[c];
    return centres;
}

}  // namespace

Polyhedra own_polyhedra(const OwnCells& own, const Solid& solid, double short_edge)
{
    require_short_edge(short_edge);
    require_sizes(own.spheres, solid);
    require_pores(own.pores, static_cast<int>(own.spheres.size()));
    CellComplex complex = Checker(own, solid).run();
    merge_close_vertices(complex, zero_edge * mean_diameter(own.spheres));
    require_centres(complex, own.spheres);
    const auto whole = static_cast<int>(own.spheres.size());
    CutCells cut = cut_cells(complex, solid, mean_diameter(own.spheres), own.joints, {}, own.holes);
    Polyhedra p;
    p.joint_cuts = std::move(cut.joints);
    set_holes(p, cut, first_hole_wall(solid, {}));
    p.hidden_spheres = own.pores;
    for (std::size_t k = 0; k < cut.sources.size(); ++k)
        if (std::binary_search(own.pores.begin(), own.pores.end(), cut.sources[k]))
            p.hidden_spheres.push_back(whole + static_cast<int>(k));
    p.hidden_spheres.insert(p.hidden_spheres.end(), cut.gone.begin(), cut.gone.end());
    std::sort(p.hidden_spheres.begin(), p.hidden_spheres.end());
    finish_cells(p, complex, centres_of(complex, own.spheres, cut.sources), short_edge);
    for (int& cell : p.sphere_of_cell) {
        const int given = cell < whole ? cell : cut.sources[cell - whole];
        const auto before = std::lower_bound(own.pores.begin(), own.pores.end(), given);
        cell = given - static_cast<int>(before - own.pores.begin());
    }
    p.hidden_spheres.clear();
    return p;
}

}  // namespace flexpm
