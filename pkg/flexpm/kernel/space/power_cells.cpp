// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Laguerre cells as the dual of CGAL's regular triangulation.
#include <flexpm/kernel/space/power_cells.hpp>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Gmpq.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Regular_triangulation_cell_base_3.h>
#include <CGAL/Regular_triangulation_vertex_base_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <array>
#include <utility>

namespace flexpm {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<int, Kernel,
    CGAL::Regular_triangulation_vertex_base_3<Kernel>>;
using CellBase = CGAL::Triangulation_cell_base_with_info_3<int, Kernel,
    CGAL::Regular_triangulation_cell_base_3<Kernel>>;
using Structure = CGAL::Triangulation_data_structure_3<VertexBase, CellBase>;
using Triangulation = CGAL::Regular_triangulation_3<Kernel, Structure>;
using WeightedPoint = Kernel::Weighted_point_3;
using Exact = CGAL::Gmpq;
template <class Number> using Triple = std::array<Number, 3>;

/// Distance of the far points, in sizes of the solid.
constexpr double far = 20.0;
/// Volume over that of a box of the same edges below which a tetrahedron's centre is found exactly:
/// with more, doubles keep twelve digits.
constexpr double flat = 1e-2;

template <class Number> Triple<Number> crossed(const Triple<Number>& a, const Triple<Number>& b)
{
    return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

template <class Number> Number dotted(const Triple<Number>& a, const Triple<Number>& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Corners 1 to 3 of a tetrahedron as seen from corner 0, and half the power differences.
template <class Number> struct Edges {
    std::array<Triple<Number>, 3> to;
    Triple<Number> half;
    std::array<Triple<Number>, 3> normals;
    Number volume;  ///< six times that of the tetrahedron

    explicit Edges(const std::array<WeightedPoint, 4>& p)
    {
        const Number weight(p[0].weight());
        for (int k = 0; k < 3; ++k) {
            for (int axis = 0; axis < 3; ++axis)
                to[k][axis] = Number(p[k + 1].point()[axis]) - Number(p[0].point()[axis]);
            half[k] = (dotted(to[k], to[k]) + weight - Number(p[k + 1].weight())) / Number(2);
        }
        for (int k = 0; k < 3; ++k)
            normals[k] = crossed(to[(k + 1) % 3], to[(k + 2) % 3]);
        volume = dotted(to[0], normals[0]);
    }

    /// Component of the point of equal power of all four corners, from corner 0, times `volume`.
    Number centre(int axis) const
    {
        return half[0] * normals[0][axis] + half[1] * normals[1][axis] + half[2] * normals[2][axis];
    }
};

/// Builder of the cells from a triangulation of spheres and far points.
class Builder {
public:
    Builder(const std::vector<Sphere>& s, const Solid& solid) : spheres(s)
    {
        triangulate(solid);
        complex.cells = static_cast<int>(s.size());
        for (auto cell : triangulation.finite_cell_handles())
            cell->info() = -1;
    }

    CellComplex run()
    {
        // the triangulation keeps its edges in the order of their addresses
        std::vector<DualFace> faces;
        for (auto edge : triangulation.finite_edges())
            add_face(faces, edge);
        std::sort(faces.begin(), faces.end(), [](const DualFace& a, const DualFace& b) {
            return std::pair(a.first, a.second) < std::pair(b.first, b.second);
        });
        for (const DualFace& face : faces) {
            complex.faces.push_back({ face.first, std::max(face.second, -1), -1, {} });
            for (Triangulation::Cell_handle cell : face.around)
                complex.faces.back().corners.push_back(vertex_of(cell));
        }
        complex.walls.resize(complex.vertices.size());
        return std::move(complex);
    }

private:
    /// A face as the tetrahedra around an edge, counter-clockwise as seen from outside `first`.
    struct DualFace {
        int first, second;  ///< spheres, or a far point as the second
        std::vector<Triangulation::Cell_handle> around;
    };

    const std::vector<Sphere>& spheres;
    Triangulation triangulation;
    CellComplex complex;

    void triangulate(const Solid& solid)
    {
        std::vector<WeightedPoint> points;
        // numbers are found again by the place: CGAL may move a hidden sphere from vertex to vertex
        std::vector<std::pair<Triple<double>, int>> index;
        const auto add = [&](Vector p, double radius, int number) {
            points.emplace_back(Kernel::Point_3(p.x, p.y, p.z), radius * radius);
            index.push_back({ { p.x, p.y, p.z }, number });
        };
        const Vector middle = 0.5 * (solid.low + solid.high);
        const double reach = far * norm(solid.high - solid.low);
        for (int k = 0; k < 8; ++k) {
            const Vector to { k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0 };
            add(middle + reach * to, 0.0, -1 - k);
        }
        for (std::size_t i = 0; i < spheres.size(); ++i)
            add(spheres[i].centre, spheres[i].radius, static_cast<int>(i));
        std::sort(index.begin(), index.end());
        triangulation.insert(points.begin(), points.end());
        for (auto v : triangulation.finite_vertex_handles()) {
            const auto& p = v->point().point();
            const Triple<double> at { p.x(), p.y(), p.z() };
            const auto found = std::lower_bound(index.begin(), index.end(), at,
                [](const auto& entry, const Triple<double>& place) { return entry.first < place; });
            v->info() = found->second;
        }
    }

    void add_face(std::vector<DualFace>& faces, const Triangulation::Edge& edge) const
    {
        const auto [cell, i, j] = edge;
        DualFace face { cell->vertex(i)->info(), cell->vertex(j)->info(), {} };
        if (face.first < 0 && face.second < 0) return;
        auto around = triangulation.incident_cells(edge), start = around;
        do {  // counter-clockwise about the way from the first to the second
            face.around.push_back(around);
        } while (++around != start);
        if (face.first < 0 || (face.second >= 0 && face.second < face.first)) {
            std::swap(face.first, face.second);
            std::reverse(face.around.begin(), face.around.end());
        }
        const auto least = std::min_element(face.around.begin(), face.around.end(),
            [](auto a, auto b) { return numbers(a) < numbers(b); });
        std::rotate(face.around.begin(), least, face.around.end());
        faces.push_back(std::move(face));
    }

    /// Spheres and far points at the corners, in order: the name of a tetrahedron.
    static std::array<int, 4> numbers(Triangulation::Cell_handle cell)
    {
        std::array<int, 4> result {};
        for (int k = 0; k < 4; ++k)
            result[k] = cell->vertex(k)->info();
        std::sort(result.begin(), result.end());
        return result;
    }

    int vertex_of(Triangulation::Cell_handle cell)
    {
        if (cell->info() < 0) {
            cell->info() = static_cast<int>(complex.vertices.size());
            complex.vertices.push_back(centre(cell));
        }
        return cell->info();
    }

    /// Point of equal power of the four corners, which are taken in the order of their numbers.
    static Vector centre(Triangulation::Cell_handle cell)
    {
        std::array<Triangulation::Vertex_handle, 4> corners {};
        for (int k = 0; k < 4; ++k)
            corners[k] = cell->vertex(k);
        std::sort(
            corners.begin(), corners.end(), [](auto a, auto b) { return a->info() > b->info(); });
        const std::array<WeightedPoint, 4> p = { corners[0]->point(), corners[1]->point(),
            corners[2]->point(), corners[3]->point() };
        const Edges<double> edges(p);
        const double box = std::sqrt(dotted(edges.to[0], edges.to[0])
            * dotted(edges.to[1], edges.to[1]) * dotted(edges.to[2], edges.to[2]));
        const auto& origin = p[0].point();
        if (std::abs(edges.volume) > flat * box) {
            return { origin.x() + edges.centre(0) / edges.volume,
                origin.y() + edges.centre(1) / edges.volume,
                origin.z() + edges.centre(2) / edges.volume };
        }
        const Edges<Exact> exact(p);
        if (exact.volume == Exact(0)) {
            fail("power_cells: tetrahedron",
                "flat at " + place(Vector { origin.x(), origin.y(), origin.z() }),
                "must have a volume; move one of its spheres");
        }
        const auto coordinate = [&](int axis) {
            return CGAL::to_double(Exact(origin[axis]) + exact.centre(axis) / exact.volume);
        };
        return { coordinate(0), coordinate(1), coordinate(2) };
    }
};

}  // namespace

CellComplex power_cells(const std::vector<Sphere>& spheres, const Solid& solid)
{
    return Builder(spheres, solid).run();
}

}  // namespace flexpm
