// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Laguerre cells as the dual of CGAL's regular triangulation, paper Sec. 3.1.
#include <flexpm/kernel/geometry/power_diagram.hpp>

#include <flexpm/kernel/geometry/disc_checks.hpp>
#include <flexpm/kernel/geometry/power.hpp>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_2.h>
#include <CGAL/Regular_triangulation_face_base_2.h>
#include <CGAL/Regular_triangulation_vertex_base_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <cmath>
#include <map>
#include <utility>

namespace flexpm {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel,
    CGAL::Regular_triangulation_vertex_base_2<Kernel>>;
using FaceBase = CGAL::Triangulation_face_base_with_info_2<int, Kernel,
    CGAL::Regular_triangulation_face_base_2<Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Triangulation = CGAL::Regular_triangulation_2<Kernel, Structure>;
using Face = Triangulation::Face_handle;

constexpr int ghost = -1;

/// Builder of the clipped cells. Every decision (is a vertex inside, where does an edge cross the
/// outline) is made once per dual vertex or edge, so that neighbours cannot disagree.
class Clipper {
public:
    Clipper(const std::vector<Disc>& d, const Outline& o) : discs(d), outline(o)
    {
        triangulate();
        for (Face f : triangulation.finite_face_handles())
            add_dual_vertex(f);
    }

    PowerDiagram run()
    {
        diagram.cells.resize(discs.size());
        for (auto v : triangulation.finite_vertex_handles())
            if (v->info() != ghost) diagram.cells[v->info()] = clip_cell(v);
        return std::move(diagram);
    }

private:
    /// A dual edge's crossings with the outline: where it enters and leaves, seen from disc a < b.
    struct Crossings {
        int enter = -1;
        int leave = -1;
    };
    /// Part of a cell's edge inside the outline.
    struct Piece {
        int start;
        int end;
        int neighbour;
    };

    const std::vector<Disc>& discs;
    const Outline& outline;
    Triangulation triangulation;
    PowerDiagram diagram;
    std::map<int, double> position;    ///< of outline vertices, along the outline
    std::map<int, int> corner_vertex;  ///< vertex of an outline corner
    std::map<std::pair<int, int>, Crossings> crossings;
    std::vector<Disc> ghosts;

    void triangulate()
    {
        // Four far discs close the outer cells; their own cells stay clear of the outline.
        const BoundingCircle box = bounding_circle(outline);
        const double far = 20.0 * box.radius;
        for (Point s : { Point { far, 0 }, Point { 0, far }, Point { -far, 0 }, Point { 0, -far } })
            ghosts.push_back({ box.centre + s, 0.0 });
        // CGAL may swap handles when a disc hides another, so indices are found again by value.
        std::map<std::pair<double, double>, int> index;
        const std::vector<bool> coincident = find_coincident(discs);
        for (std::size_t i = 0; i < discs.size(); ++i)
            if (!coincident[i])
                index[{ discs[i].centre.x, discs[i].centre.y }] = static_cast<int>(i);
        for (const Disc& d : ghosts)
            insert(d);
        for (const auto& entry : index)
            insert(discs[entry.second]);
        for (auto v : triangulation.finite_vertex_handles()) {
            const auto at = index.find({ v->point().point().x(), v->point().point().y() });
            v->info() = at == index.end() ? ghost : at->second;
        }
    }

    void insert(const Disc& d)
    {
        triangulation.insert({ { d.centre.x, d.centre.y }, d.radius * d.radius });
    }

    Disc disc_of(Triangulation::Vertex_handle v) const
    {
        if (v->info() != ghost) return discs[v->info()];
        return { { v->point().point().x(), v->point().point().y() }, 0.0 };
    }

    int add_vertex(Point p, VertexKind kind)
    {
        diagram.vertices.push_back(p);
        diagram.kinds.push_back(kind);
        return static_cast<int>(diagram.vertices.size()) - 1;
    }

    void add_dual_vertex(Face f)
    {
        f->info() = -1;
        for (int k = 0; k < 3; ++k)
            if (f->vertex(k)->info() == ghost) return;
        const Point p =
            radical_centre(disc_of(f->vertex(0)), disc_of(f->vertex(1)), disc_of(f->vertex(2)));
        if (contains(outline, p)) f->info() = add_vertex(p, VertexKind::inner);
    }

    int add_crossing(const OutlinePoint& at)
    {
        const int v = add_vertex(at.point, VertexKind::side);
        position[v] = at.position;
        return v;
    }

    /// Crossings of the edge between discs a < b, walked with a on the left, from vertex to vertex.
    const Crossings& cross(int a, int b, bool from_inside, bool to_inside, Point from, Point to)
    {
        const auto [at, added] = crossings.try_emplace({ a, b });
        if (!added || (from_inside && to_inside)) return at->second;
        const Chord chord = clip_radical_axis(outline, discs[a], discs[b]);
        if (from_inside) {
            at->second.leave = add_crossing(chord.leave);
        } else if (to_inside) {
            at->second.enter = add_crossing(chord.enter);
        } else if (chord.exists && along(chord.leave.point, from, a, b) > 0.0
            && along(to, chord.enter.point, a, b) > 0.0) {
            at->second = { add_crossing(chord.enter), add_crossing(chord.leave) };
        }
        return at->second;
    }

    /// Distance (times a constant) of p beyond q in the walking direction, a on the left.
    double along(Point p, Point q, int a, int b) const
    {
        return flexpm::cross(discs[b].centre - discs[a].centre, p - q);
    }

    Point dual_position(Face f) const
    {
        if (f->info() >= 0) return diagram.vertices[f->info()];
        return radical_centre(disc_of(f->vertex(0)), disc_of(f->vertex(1)), disc_of(f->vertex(2)));
    }

    /// Part inside the outline of the edge of cell i from dual vertex `from` to `to`.
    bool clip_edge(int i, int j, Face from, Face to, Piece& piece)
    {
        const bool in0 = from->info() >= 0, in1 = to->info() >= 0;
        const bool reversed = i > j;
        const Crossings& c = reversed
            ? cross(j, i, in1, in0, dual_position(to), dual_position(from))
            : cross(i, j, in0, in1, dual_position(from), dual_position(to));
        const int enter = reversed ? c.leave : c.enter, leave = reversed ? c.enter : c.leave;
        piece = { in0 ? from->info() : enter, in1 ? to->info() : leave, j };
        return piece.start >= 0 && piece.end >= 0;
    }

    std::vector<CellEdge> clip_cell(Triangulation::Vertex_handle v)
    {
        std::vector<Piece> pieces;
        auto face = triangulation.incident_faces(v), first = face;
        do {  // counter-clockwise; two consecutive faces share the neighbour cw(v)
            const Face from = face;
            const auto w = from->vertex(Triangulation::cw(from->index(v)));
            ++face;
            Piece piece;
            if (w->info() != ghost && clip_edge(v->info(), w->info(), from, face, piece))
                pieces.push_back(piece);
        } while (face != first);
        if (pieces.empty()) return whole_outline(v->info());

        std::vector<CellEdge> edges;
        for (std::size_t k = 0; k < pieces.size(); ++k) {
            edges.push_back({ pieces[k].start, pieces[k].neighbour, -1 });
            const int next = pieces[(k + 1) % pieces.size()].start;
            if (pieces[k].end != next) follow_outline(pieces[k].end, next, edges);
        }
        return edges;
    }

    int corner(int side)
    {
        const auto [at, added] = corner_vertex.try_emplace(side, -1);
        if (added) at->second = add_vertex(outline.corners[side], VertexKind::corner);
        return at->second;
    }

    /// Edges of a cell along the outline, counter-clockwise from one crossing to the next.
    void follow_outline(int start, int end, std::vector<CellEdge>& edges)
    {
        const double s0 = position.at(start), s1 = position.at(end);
        int side = outline.is_circle() ? 0 : static_cast<int>(s0);
        edges.push_back({ start, -1, side });
        if (outline.is_circle()) return;
        const int n = outline.sides();
        const double gap = std::fmod(s1 - s0 + n, n);
        if (gap > n - 1e-9) return;  // two crossings in one point, swapped by round-off
        for (double s = side + 1.0; s < s0 + gap; s += 1.0) {
            side = (side + 1) % n;
            edges.push_back({ corner(side), -1, side });
        }
    }

    /// A cell without an edge inside the outline holds all of it or nothing.
    std::vector<CellEdge> whole_outline(int i)
    {
        const Point probe = outline.is_circle() ? outline.centre : outline.corners[0];
        for (const Disc& d : discs)
            if (power(probe, d) < power(probe, discs[i])) return {};
        std::vector<CellEdge> edges;
        for (int side = 0; !outline.is_circle() && side < outline.sides(); ++side)
            edges.push_back({ corner(side), -1, side });
        return edges;
    }
};

}  // namespace

PowerDiagram power_diagram(const std::vector<Disc>& discs, const Outline& outline)
{
    require_discs_inside(discs, outline);
    return Clipper(discs, outline).run();
}

}  // namespace flexpm
