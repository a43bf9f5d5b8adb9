// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The part of a cell in a polyhedron is between clipped faces of both.
#include <flexpm/kernel/space/hole_cuts.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace flexpm {
namespace {

/// Volume of a cell, and of its part in a hole.
struct Parts {
    double whole = 0.0;
    double inside = 0.0;
};

/// Half-spaces of a cell, and its faces as seen from outside.
struct Shape {
    std::vector<HalfSpace> halves;
    std::vector<std::vector<Vector>> faces;
};

Shape shape_of(const CellComplex& complex, const std::vector<int>& faces, int cell)
{
    Shape shape;
    for (int f : faces) {
        std::vector<Vector> polygon;
        for (int v : complex.faces[f].corners)
            polygon.push_back(complex.vertices[v]);
        Vector area = area_vector(complex, complex.faces[f].corners);
        if (complex.faces[f].first != cell) {
            std::reverse(polygon.begin(), polygon.end());
            area = -1.0 * area;
        }
        const double size = norm(area);
        if (size > 0.0) {
            const Vector normal = (1.0 / size) * area;
            shape.halves.push_back({ normal, dot(normal, polygon.front()) });
        }
        shape.faces.push_back(std::move(polygon));
    }
    return shape;
}

Parts parts_of(const CellComplex& complex, const std::vector<int>& faces, int cell,
    const HoleCut& hole, double close)
{
    constexpr double far = std::numeric_limits<double>::infinity();
    std::vector<int> crossed;  // facets whose planes have the cell on both sides
    std::vector<HalfSpace> region;
    for (std::size_t k = 0; k < hole.facets.size(); ++k) {
        const PlaneCut& facet = hole.facets[k];
        double low = far, high = -far;
        for (int f : faces)
            for (int v : complex.faces[f].corners) {
                const double off = dot(facet.normal, complex.vertices[v]) - facet.offset;
                low = std::min(low, off);
                high = std::max(high, off);
            }
        if (low >= -close) return {};
        if (high <= close) continue;
        crossed.push_back(static_cast<int>(k));
        region.push_back({ facet.normal, facet.offset });
    }
    const Shape shape = shape_of(complex, faces, cell);
    const Vector origin = shape.faces.front().front();
    Parts sixfold;
    for (const auto& face : shape.faces) {
        sixfold.whole += six_volumes_below(face, origin);
        sixfold.inside += six_volumes_below(part_within(face, region), origin);
    }
    for (int k : crossed)
        sixfold.inside += six_volumes_below(part_within(hole.polygons[k], shape.halves), origin);
    return { sixfold.whole / 6.0, sixfold.inside / 6.0 };
}

/// Largest distance of the corners of a face from a plane.
double distance_of_face(const CellComplex& complex, const CellFace& face, const PlaneCut& plane)
{
    double off = 0.0;
    for (int v : face.corners)
        off = std::max(off, std::fabs(dot(plane.normal, complex.vertices[v]) - plane.offset));
    return off;
}

/// Faces on the wall of a hole belong to the nearest facet, into which their corners are moved when
/// short edges are collapsed.
void choose_facets(CellComplex& complex, const HoleCut& hole, double close)
{
    for (CellFace& face : complex.faces) {
        if (face.wall != hole.wall) continue;
        const auto nearest = std::min_element(
            hole.facets.begin(), hole.facets.end(), [&](const PlaneCut& a, const PlaneCut& b) {
                return distance_of_face(complex, face, a) < distance_of_face(complex, face, b);
            });
        face.joint = nearest->joint;
        for (int v : face.corners) {
            const double off = dot(nearest->normal, complex.vertices[v]) - nearest->offset;
            auto& walls = complex.walls[v];
            const auto at = std::lower_bound(walls.begin(), walls.end(), nearest->wall);
            const bool is_new = at == walls.end() || *at != nearest->wall;
            if (std::fabs(off) <= close && is_new) walls.insert(at, nearest->wall);
        }
    }
}

}  // namespace

HoleOutcome cut_hole(CellComplex& complex, CellCutter& cutter, const HoleCut& hole, double close,
    std::vector<int>& gone)
{
    // at an edge a part may be too small until the second facet has cut the cell
    for (int round = 0; round < 2; ++round)
        for (const PlaneCut& facet : hole.facets)
            cutter.cut_by_plane(facet);
    HoleOutcome found;
    std::vector<int> taken;
    for (int cell = 0; cell < complex.cells; ++cell) {
        const auto& faces = cutter.faces_of(cell);
        if (faces.empty()) continue;
        const Parts parts = parts_of(complex, faces, cell, hole, close);
        found.within += parts.inside;
        if (!(parts.whole > 0.0 && parts.inside >= 0.5 * parts.whole)) continue;
        found.removed += parts.whole;
        taken.push_back(cell);
    }
    cutter.take_out(taken, hole.wall);
    choose_facets(complex, hole, close);
    gone.insert(gone.end(), taken.begin(), taken.end());
    return found;
}

void finish_holes(CellComplex& complex, int first_facet)
{
    complex.has_holes = true;
    auto& faces = complex.faces;
    faces.erase(std::remove_if(faces.begin(), faces.end(),
                    [](const CellFace& face) { return face.corners.empty(); }),
        faces.end());
    std::set<std::pair<int, int>> on_hole;  // vertex, wall
    for (CellFace& face : faces) {
        if (face.joint < first_facet) continue;
        if (face.second >= 0) {
            face.joint = -1;
            continue;
        }
        for (int v : face.corners)
            on_hole.emplace(v, complex.first_joint + face.joint);
    }
    const int first_wall = complex.first_joint + first_facet;
    for (std::size_t v = 0; v < complex.walls.size(); ++v) {
        auto& walls = complex.walls[v];
        walls.erase(
            std::remove_if(walls.begin(), walls.end(),
                [&](int wall) {
                    return wall >= first_wall && on_hole.count({ static_cast<int>(v), wall }) == 0;
                }),
            walls.end());
    }
}

}  // namespace flexpm
