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
template <class Visit> void for_each_neighbour(const Assembly& a, double size, Visit visit)
{
    using Place = std::pair<double, double>;  // row and column, whole numbers of any size
    std::vector<std::pair<Place, int>> places;
    for (int g = 0; g < a.grains; ++g) {
        const Point p = a.position(a.centre(g));
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

bool is_near(const Assembly& a, GrainPair pair, double margin)
{
    const double reach = a.radius[pair[0]] + a.radius[pair[1]] + margin;
    return square_distance(a, pair) < reach * reach;
}

/// A centre is further than `way` from where it was.
bool any_moved(const Assembly& a, const std::vector<Point>& from, double way)
{
    for (int g = 0; g < a.grains; ++g) {
        const Point p = a.position(a.centre(g));
        const double dx = p.x - from[g].x, dy = p.y - from[g].y;
        if (!(dx * dx + dy * dy <= way * way)) return true;
    }
    return false;
}

}  // namespace

std::vector<GrainPair> near_pairs(const Assembly& a, double margin)
{
    std::vector<std::pair<int, int>> held;
    for (int c = 0; c < a.contacts; ++c) {
        if (carries(a, c)) held.push_back({ a.contact_grains[2 * c], a.contact_grains[2 * c + 1] });
    }
    if (!std::is_sorted(held.begin(), held.end())) std::sort(held.begin(), held.end());
    const double largest = *std::max_element(a.radius.begin(), a.radius.end());
    std::vector<GrainPair> near;
    // a little more, so that round-off does not choose
    for_each_neighbour(a, 1.001 * (2.0 * largest + margin), [&](GrainPair pair) {
        if (!is_near(a, pair, margin)) return;
        const std::pair<int, int> key { pair[0], pair[1] };
        if (!std::binary_search(held.begin(), held.end(), key)) near.push_back(pair);
    });
    std::sort(near.begin(), near.end());
    return near;
}

const std::vector<GrainPair>& NearPairs::find(const Assembly& a, double margin)
{
    // two grains that move by a quarter of the margin each come no closer than half of it
    if (from.empty() || margin != watched_margin || any_moved(a, from, 0.24 * margin)) {
        watched = near_pairs(a, 1.5 * margin);
        watched_margin = margin;
        from.clear();
        for (int g = 0; g < a.grains; ++g)
            from.push_back(a.position(a.centre(g)));
    }
    near.clear();
    std::copy_if(watched.begin(), watched.end(), std::back_inserter(near),
        [&](GrainPair pair) { return is_near(a, pair, margin); });
    return near;
}

}  // namespace flexpm
