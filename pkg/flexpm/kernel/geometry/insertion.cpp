// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Trials of random places until one is free; square bins hold the discs near it.
#include <flexpm/kernel/geometry/insertion.hpp>

#include <flexpm/kernel/core/random.hpp>
#include <flexpm/kernel/core/require.hpp>

#include <algorithm>
#include <numeric>

namespace flexpm {
namespace {

constexpr int most_tries = 10000;

struct Box {
    Point low;
    Point high;
};

Box box_of(const Outline& outline)
{
    const BoundingCircle all = bounding_circle(outline);
    if (outline.is_circle())
        return { { all.centre.x - all.radius, all.centre.y - all.radius },
            { all.centre.x + all.radius, all.centre.y + all.radius } };
    Box box { outline.corners[0], outline.corners[0] };
    for (Point c : outline.corners) {
        box.low = { std::min(box.low.x, c.x), std::min(box.low.y, c.y) };
        box.high = { std::max(box.high.x, c.x), std::max(box.high.y, c.y) };
    }
    return box;
}

/// Square bins of one largest diameter: a disc can only touch discs of the nine bins around it.
class Bins {
public:
    Bins(const Box& box, double largest_radius) :
        low(box.low),
        size(2.0 * largest_radius),
        columns(static_cast<int>((box.high.x - box.low.x) / size) + 1),
        rows(static_cast<int>((box.high.y - box.low.y) / size) + 1),
        discs(static_cast<std::size_t>(columns) * rows)
    {
    }

    void add(const Disc& d) { discs[row(d.centre.y) * columns + column(d.centre.x)].push_back(d); }

    bool is_free(const Disc& d) const
    {
        const int i0 = column(d.centre.x), j0 = row(d.centre.y);
        for (int j = std::max(j0 - 1, 0); j <= std::min(j0 + 1, rows - 1); ++j)
            for (int i = std::max(i0 - 1, 0); i <= std::min(i0 + 1, columns - 1); ++i)
                for (const Disc& e : discs[j * columns + i])
                    if (norm(e.centre - d.centre) < e.radius + d.radius) return false;
        return true;
    }

private:
    Point low;
    double size;
    int columns, rows;
    std::vector<std::vector<Disc>> discs;

    int column(double x) const
    {
        return std::clamp(static_cast<int>((x - low.x) / size), 0, columns - 1);
    }
    int row(double y) const
    {
        return std::clamp(static_cast<int>((y - low.y) / size), 0, rows - 1);
    }
};

}  // namespace

std::vector<Point> insert_discs(
    const std::vector<double>& radii, const Outline& outline, double shrink, std::uint64_t seed)
{
    if (radii.empty()) return {};
    std::vector<int> order(radii.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return radii[i] > radii[j]; });

    const Box box = box_of(outline);
    Bins bins(box, shrink * radii[order[0]]);
    Random random(seed);
    std::vector<Point> centres(radii.size());
    for (int i : order) {
        Disc d { {}, shrink * radii[i] };
        int tries = 0;
        do {
            if (++tries > most_tries) {
                refuse("insert_discs: radius", radii[i], "m",
                    "must fit into the outline beside the other discs; choose smaller or fewer "
                    "discs");
            }
            d.centre.x = box.low.x + (box.high.x - box.low.x) * random.next();
            d.centre.y = box.low.y + (box.high.y - box.low.y) * random.next();
        } while (distance_inside(outline, d.centre) < d.radius || !bins.is_free(d));
        bins.add(d);
        centres[i] = d.centre;
    }
    return centres;
}

}  // namespace flexpm
