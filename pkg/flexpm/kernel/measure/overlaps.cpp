// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/measure/overlaps.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/geometry/polygon.hpp>
#include <flexpm/kernel/plane_lanes/bond_faces.hpp>

#include <algorithm>
#include <cstddef>

namespace flexpm {

namespace {

using Polygon = std::vector<Point>;

Polygon outline_of(const Grains& grains, int grain)
{
    Polygon corners;
    for (int k = 0; k < grains.vertices_of(grain); ++k)
        corners.push_back(grains.point_at(grains.node(grain, k)));
    return corners;
}

/// The part of a polygon that lies to the left of a line.
Polygon left_of(const Polygon& polygon, Point from, Point along)
{
    Polygon kept;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Point p = polygon[k], q = polygon[(k + 1) % polygon.size()];
        const double left_p = cross(along, p - from), left_q = cross(along, q - from);
        if (left_p >= 0.0) kept.push_back(p);
        if ((left_p < 0.0) != (left_q < 0.0))
            kept.push_back(p + (left_p / (left_p - left_q)) * (q - p));
    }
    return kept;
}

double common_area(Polygon of_a, const Polygon& of_b)
{
    for (std::size_t k = 0; k < of_b.size() && !of_a.empty(); ++k) {
        const Point from = of_b[k];
        of_a = left_of(of_a, from, of_b[(k + 1) % of_b.size()] - from);
    }
    return polygon_shape(of_a).area;
}

/// Extent along x and y.
struct Box {
    Point least, most;
    int grain;
};

Box box_of(const Polygon& polygon, int grain)
{
    Box box { polygon[0], polygon[0], grain };
    for (Point p : polygon) {
        box.least = { std::min(box.least.x, p.x), std::min(box.least.y, p.y) };
        box.most = { std::max(box.most.x, p.x), std::max(box.most.y, p.y) };
    }
    return box;
}

/// Calls visit(g, h) for all pairs of grains whose boxes overlap, g < h.
template <class Visit> void for_each_near(std::vector<Box> boxes, Visit visit)
{
    std::sort(boxes.begin(), boxes.end(),
        [](const Box& b, const Box& c) { return b.least.x < c.least.x; });
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        for (std::size_t j = i + 1; j < boxes.size() && boxes[j].least.x < boxes[i].most.x; ++j) {
            const Box &b = boxes[i], &c = boxes[j];
            if (b.least.y < c.most.y && c.least.y < b.most.y)
                visit(std::min(b.grain, c.grain), std::max(b.grain, c.grain));
        }
    }
}

/// Mean closure of a contact times its length [m^2].
double closed_area(const Assembly& a, int contact)
{
    double sum = 0.0;
    for (int p = 0; p < a.contacts.points_of(contact); ++p) {
        sum -= a.contacts.area(contact, p) * std::min(gap_of(a.contacts, contact, p), 0.0);
    }
    return a.length_of(sum);
}

/// What contacts say of an overlap.
void add_contacts(const Assembly& a, Overlap& overlap)
{
    const auto& pairs = a.contacts.pairs;
    const auto all = std::equal_range(pairs.begin(), pairs.end(), overlap.pair);
    for (auto one = all.first; one != all.second; ++one) {
        const int c = static_cast<int>(one - pairs.begin());
        overlap.closed += closed_area(a, c);
        if (!a.contacts.bonded[c] || a.contacts.joint[c] >= 0) continue;
        overlap.bonded = true;
        overlap.facing = overlap.facing || is_facing(bond_faces(a, c));
    }
}

}  // namespace

std::vector<Overlap> find_overlaps(const Assembly& a, double smallest_part)
{
    std::vector<Polygon> outlines(a.grains.count);
    std::vector<Box> boxes;
    for (int g = 0; g < a.grains.count; ++g) {
        outlines[g] = outline_of(a.grains, g);
        const bool is_somewhere = std::all_of(
            outlines[g].begin(), outlines[g].end(), [](Point p) { return is_finite(p); });
        if (!a.grains.erased[g] && is_somewhere) boxes.push_back(box_of(outlines[g], g));
    }
    std::vector<Overlap> found;
    for_each_near(boxes, [&](int g, int h) {
        const double area = common_area(outlines[g], outlines[h]);
        const double least =
            std::min(polygon_shape(outlines[g]).area, polygon_shape(outlines[h]).area);
        if (!(area > smallest_part * least)) return;
        Overlap overlap { { g, h }, area, area / least, false, false, 0.0 };
        add_contacts(a, overlap);
        found.push_back(overlap);
    });
    std::sort(found.begin(), found.end(),
        [](const Overlap& o, const Overlap& p) { return o.pair < p.pair; });
    return found;
}

}  // namespace flexpm
