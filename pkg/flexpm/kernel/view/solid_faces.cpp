// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/view/solid_faces.hpp>

#include <flexpm/kernel/space_lanes/solid_access.hpp>
#include <flexpm/kernel/space_lanes/tetrahedron_forces.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace flexpm {

namespace {

/// Where the way between two places meets the plane.
Vector meeting(Vector a, Vector b, const CutPlane& plane)
{
    const double from = plane.beyond(a), to = plane.beyond(b);
    return a + (from / (from - to)) * (b - a);
}

NodePair pair_of(int a, int b) { return { std::min(a, b), std::max(a, b) }; }

/// Edges between triangles of different walls.
void add_wall_edges(const SolidState& s, std::vector<std::vector<NodePair>>& edges)
{
    std::map<NodePair, int> side;  // of the first triangle at each edge
    for (std::size_t t = 0; t < s.surface.nodes.size(); ++t) {
        const auto& n = s.surface.nodes[t];
        for (int k = 0; k < 3; ++k) {
            const auto found = side.insert({ pair_of(n[k], n[(k + 1) % 3]), s.surface.side[t] });
            if (found.first->second != s.surface.side[t])
                edges[s.surface.grain[t]].push_back(found.first->first);
        }
    }
}

/// The triangle or quadrangle in which the plane cuts a tetrahedron, if it does.
Polygon section_of(const std::array<Vector, 4>& corners, const CutPlane& plane)
{
    static constexpr int ends[6][2] = { { 0, 1 }, { 0, 2 }, { 0, 3 }, { 1, 2 }, { 1, 3 },
        { 2, 3 } };
    Polygon found;
    for (const auto& edge : ends) {
        const Vector a = corners[edge[0]], b = corners[edge[1]];
        if ((plane.beyond(a) > 0.0) != (plane.beyond(b) > 0.0))
            found.push_back(meeting(a, b, plane));
    }
    // the first and the last of four crossed edges share no corner: they lie across
    if (found.size() == 4) std::swap(found[2], found[3]);
    // a window may leave out what is turned away
    if (found.size() > 2 && dot(normal_of(found), plane.normal) < 0.0)
        std::reverse(found.begin(), found.end());
    return found;
}

}  // namespace

Polygon in_front(const Polygon& polygon, const CutPlane& plane)
{
    if (!plane.cuts()) return polygon;
    Polygon left;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vector a = polygon[k], b = polygon[(k + 1) % polygon.size()];
        const bool gone = plane.beyond(a) > 0.0;
        if (!gone) left.push_back(a);
        if (gone != (plane.beyond(b) > 0.0)) left.push_back(meeting(a, b, plane));
    }
    return left;
}

Segment in_front(const Segment& line, const CutPlane& plane)
{
    const bool first = plane.beyond(line[0]) > 0.0, second = plane.beyond(line[1]) > 0.0;
    if (!plane.cuts() || (!first && !second)) return line;
    if (first && second) return {};
    Segment left = line;
    left[first ? 0 : 1] = meeting(line[0], line[1], plane);
    return left;
}

Segment cut_line(const Polygon& polygon, const CutPlane& plane)
{
    Segment line {};
    int ends = 0;
    for (std::size_t k = 0; plane.cuts() && k < polygon.size(); ++k) {
        const Vector a = polygon[k], b = polygon[(k + 1) % polygon.size()];
        if ((plane.beyond(a) > 0.0) == (plane.beyond(b) > 0.0) || ends == 2) continue;
        line[ends++] = meeting(a, b, plane);
    }
    return ends == 2 ? line : Segment {};
}

std::vector<std::vector<NodePair>> polyhedron_edges(const SolidState& s)
{
    std::vector<std::vector<NodePair>> edges(s.grains.count);
    const FaceContacts& c = s.contacts;
    for (int contact = 0; contact < c.count; ++contact) {
        const int corners = c.corners_of(contact);
        for (int side = 0; side < 2; ++side) {
            auto& own = edges[c.pairs[contact][side]];
            for (int k = 0; k < corners; ++k)
                own.push_back(
                    pair_of(c.node(contact, side, k), c.node(contact, side, (k + 1) % corners)));
        }
    }
    add_wall_edges(s, edges);
    for (auto& own : edges) {
        std::sort(own.begin(), own.end());
        own.erase(std::unique(own.begin(), own.end()), own.end());
    }
    return edges;
}

GrainFaces grain_faces(const SolidState& s, int grain, const std::vector<NodePair>& edges,
    double factor, const CutPlane& plane)
{
    GrainFaces found;
    const auto add = [](Polygon polygon, std::vector<Polygon>& to) {
        if (polygon.size() > 2) to.push_back(std::move(polygon));
    };
    const auto add_line = [&](const Segment& line) {
        if (norm(line[1] - line[0]) > 0.0) found.lines.push_back(line);
    };
    const auto place = [&](int node) { return s.grains.position(node, factor); };
    for_each_tetrahedron(
        s, s.grains.block_of(grain), [&](const TetrahedronShape&, const std::array<int, 4>& nodes) {
            const Polygon outer { place(nodes[1]), place(nodes[2]), place(nodes[3]) };
            add(in_front(outer, plane), found.outside);
            if (!plane.cuts()) return;
            add(section_of({ place(nodes[0]), outer[0], outer[1], outer[2] }, plane),
                found.section);
            add_line(cut_line(outer, plane));
        });
    for (const NodePair& edge : edges)
        add_line(in_front(Segment { place(edge[0]), place(edge[1]) }, plane));
    return found;
}

std::vector<Polygon> point_part(const SolidState& s, int contact, int point, double factor)
{
    const Polygon face = middle_face(s, contact, factor);
    const FaceGroup& group = s.contacts.group_of(contact);
    if (group.points - group.at_corners > 1) return { face };
    Vector middle;
    for (const Vector& corner : face)
        middle = middle + (1.0 / static_cast<double>(face.size())) * corner;
    // the inner polygon, which stands for the point that is no corner
    double shrunk = 0.0;
    if (group.points > group.at_corners) {
        shrunk = std::sqrt(
            s.contacts.area(contact, group.points - 1) / contact_area(s.contacts, contact));
    }
    const auto inner = [&](Vector place) { return middle + shrunk * (place - middle); };
    if (point >= group.at_corners) {
        Polygon part;
        for (const Vector& corner : face)
            part.push_back(inner(corner));
        return { part };
    }
    const int count = static_cast<int>(face.size());
    const Vector corner = face[point];
    std::vector<Polygon> parts;
    for (int next : { (point + count - 1) % count, (point + 1) % count }) {
        const Vector half = 0.5 * (corner + face[next]);
        parts.push_back({ corner, half, inner(half), inner(corner) });
    }
    return parts;
}

std::vector<bool> surface_nodes(const SolidState& s)
{
    std::vector<bool> found(s.grains.inverse_mass.size(), false);
    for (const auto& triangle : s.surface.nodes)
        for (int node : triangle)
            found[s.grains.scalar_index(node)] = true;
    return found;
}

std::vector<Segment> point_rim(
    const SolidState& s, int contact, int point, double factor, const std::vector<bool>& on_surface)
{
    const FaceContacts& c = s.contacts;
    if (point >= c.group_of(contact).at_corners) return {};
    const auto is_outer = [&](int corner) {
        return on_surface[s.grains.scalar_index(c.node(contact, 0, corner))];
    };
    const Polygon face = middle_face(s, contact, factor);
    const int count = c.corners_of(contact);
    std::vector<Segment> found;
    for (int next : { (point + count - 1) % count, (point + 1) % count }) {
        if (is_outer(point) && is_outer(next))
            found.push_back({ face[point], 0.5 * (face[point] + face[next]) });
    }
    return found;
}

}  // namespace flexpm
