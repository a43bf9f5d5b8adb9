// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Store of the templates, each made when first asked for.
#include <flexpm/kernel/fem/mesh_template.hpp>

#include <flexpm/kernel/core/require.hpp>

#include <map>
#include <mutex>
#include <utility>

namespace flexpm {
namespace {

MeshTemplate fan(int v)
{
    MeshTemplate t { v, v + 1, {} };
    for (int k = 0; k < v; ++k)
        t.triangles.push_back({ k, (k + 1) % v, v });
    return t;
}

/// Template of a triangle. A half-size triangle with one edge merged would put the centre on the
/// ring. Instead there are two inner nodes, half way from the centre to the middles of the first
/// two edges.
MeshTemplate refined_triangle()
{
    constexpr int c = 3, p0 = 4, p1 = 5;
    return { 3, 6,
        { { 0, 1, p0 }, { 1, p1, p0 }, { 1, 2, p1 }, { 2, c, p1 }, { 2, 0, c }, { 0, p0, c },
            { c, p0, p1 } } };
}

MeshTemplate refined(int v)
{
    if (v == 3) return refined_triangle();
    MeshTemplate t { v, 2 * v, {} };
    const int centre = v, merged = v + 1;
    const auto ring = [&](int k) { return k == 0 || k == v - 1 ? merged : v + 1 + k; };
    t.triangles.push_back({ v - 1, 0, merged });
    for (int k = 0; k < v - 1; ++k) {
        // Diagonals lean away from the merged node, the same way on both sides of it.
        if (2 * k < v - 1) {
            t.triangles.push_back({ k, k + 1, ring(k + 1) });
            t.triangles.push_back({ k, ring(k + 1), ring(k) });
        } else {
            t.triangles.push_back({ k, k + 1, ring(k) });
            t.triangles.push_back({ k + 1, ring(k + 1), ring(k) });
        }
    }
    for (int k = 0; k < v - 1; ++k)
        t.triangles.push_back({ ring(k), ring(k + 1), centre });
    return t;
}

Point between(Point a, Point b) { return 0.5 * (a + b); }

}  // namespace

const MeshTemplate& mesh_template(int vertices, MeshKind kind)
{
    if (vertices < 3)
        refuse("mesh_template: vertices", vertices, "", "must be >= 3; give a polygon");
    static std::mutex guard;
    static std::map<std::pair<int, MeshKind>, MeshTemplate> templates;
    const std::lock_guard<std::mutex> lock(guard);
    MeshTemplate& t = templates[{ vertices, kind }];
    if (t.nodes == 0) t = kind == MeshKind::fan ? fan(vertices) : refined(vertices);
    return t;
}

std::vector<Point> template_nodes(const std::vector<Point>& corners, Point centre, MeshKind kind)
{
    const std::size_t v = corners.size();
    std::vector<Point> nodes = corners;
    nodes.push_back(centre);
    if (kind == MeshKind::fan) return nodes;
    if (v == 3) {
        nodes.push_back(between(centre, between(corners[0], corners[1])));
        nodes.push_back(between(centre, between(corners[1], corners[2])));
        return nodes;
    }
    nodes.push_back(between(centre, between(corners[v - 1], corners[0])));
    for (std::size_t k = 1; k + 1 < v; ++k)
        nodes.push_back(between(centre, corners[k]));
    return nodes;
}

}  // namespace flexpm
