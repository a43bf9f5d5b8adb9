// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Pairs of grains that may come to touch.
#include <flexpm/kernel/topology/contact_search.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace flexpm {

namespace {

/// Calls visit(pair) for all pairs of grains that lie in the same cell, or in two that touch, of a
/// lattice of squares of side `size`.
template <class Visit> void for_each_neighbour(const Grains& grains, double size, Visit visit)
{
    using Place = std::pair<double, double>;  // row and column, whole numbers of any size
    std::vector<std::pair<Place, int>> places;
    for (int g = 0; g < grains.count; ++g) {
        if (grains.erased[g]) continue;
        const Point p = grains.point_at(grains.centre(g));
        if (!is_finite(p)) continue;  // no order would hold; the next check reports it
        places.push_back({ { std::floor(p.y / size), std::floor(p.x / size) }, g });
    }
    std::sort(places.begin(), places.end());
    const auto visit_row = [&](std::size_t from, const std::pair<Place, int>& one, Place last) {
        for (std::size_t i = from; i < places.size() && places[i].first <= last; ++i) {
            const int g = one.second, h = places[i].second;
            visit(GrainPair { std::min(g, h), std::max(g, h) });
        }
    };
    std::size_t above = 0;  // first place in the next row that is not left of the neighbours
    for (std::size_t i = 0; i < places.size(); ++i) {
        const auto [row, column] = places[i].first;
        visit_row(i + 1, places[i], { row, column + 1.0 });
        while (above < places.size() && places[above].first < Place { row + 1.0, column - 1.0 })
            ++above;
        visit_row(above, places[i], { row + 1.0, column + 1.0 });
    }
}

bool is_near(const Grains& grains, GrainPair pair, double margin)
{
    const double distance = grains.radius[pair[0]] + grains.radius[pair[1]] + margin;
    return square_distance(grains, pair) < distance * distance;
}

/// A centre is further than `distance` from where it was.
bool any_moved(const Grains& grains, const std::vector<Point>& from, double distance)
{
    for (int g = 0; g < grains.count; ++g) {
        const Point way = grains.point_at(grains.centre(g)) - from[g];
        if (!(dot(way, way) <= distance * distance)) return true;
    }
    return false;
}

}  // namespace

std::vector<GrainPair> near_pairs(const Assembly& a, double margin)
{
    std::vector<GrainPair> bound;  // by an active contact
    for (int c = 0; c < a.contacts.count; ++c) {
        if (is_active(a.contacts, c)) bound.push_back(a.contacts.pairs[c]);
    }
    if (!std::is_sorted(bound.begin(), bound.end())) std::sort(bound.begin(), bound.end());
    const double largest = *std::max_element(a.grains.radius.begin(), a.grains.radius.end());
    std::vector<GrainPair> near;
    // a little more, so that round-off does not choose
    for_each_neighbour(a.grains, 1.001 * (2.0 * largest + margin), [&](GrainPair pair) {
        if (!is_near(a.grains, pair, margin)) return;
        if (!std::binary_search(bound.begin(), bound.end(), pair)) near.push_back(pair);
    });
    std::sort(near.begin(), near.end());
    return near;
}

const std::vector<GrainPair>& NearPairs::find(const Assembly& a, double margin)
{
    // two grains that move by a quarter of the margin each come no closer than half of it
    if (from.empty() || margin != watched_margin || any_moved(a.grains, from, 0.24 * margin)) {
        watched = near_pairs(a, 1.5 * margin);
        watched_margin = margin;
        from.clear();
        for (int g = 0; g < a.grains.count; ++g)
            from.push_back(a.grains.point_at(a.grains.centre(g)));
    }
    near.clear();
    std::copy_if(watched.begin(), watched.end(), std::back_inserter(near),
        [&](GrainPair pair) { return is_near(a.grains, pair, margin); });
    return near;
}

}  // namespace flexpm
