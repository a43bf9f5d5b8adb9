// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Seeds in a grain that is star-shaped and not convex.
#include <flexpm/kernel/geometry/lloyd.hpp>
#include <flexpm/kernel/geometry/polygon.hpp>

#include "support/catch.hpp"

#include <algorithm>
#include <set>

using namespace flexpm;

namespace {

const std::vector<Point> dented { { 0.0, 0.0 }, { 4.0, 0.0 }, { 4.0, 3.0 }, { 2.0, 2.5 },
    { 0.0, 3.0 } };

}  // namespace

TEST_CASE("cells fill a grain with a dent evenly", "[inner]")
{
    const int count = 20;
    const InnerPacking packing = relax_seeds(dented, count);
    const double whole = polygon_shape(dented).area;
    double total = 0.0;
    for (const auto& cell : packing.cells) {
        std::vector<Point> corners;
        for (const InnerCorner& c : cell)
            corners.push_back(c.point);
        const double area = polygon_shape(corners).area;
        CHECK(area == Approx(whole / count).epsilon(0.02));
        total += area;
    }
    CHECK(total == Approx(whole).epsilon(1e-13));
}

TEST_CASE(
    "few seeds in a long grain, which would swap their places for ever, all keep a cell", "[inner]")
{
    const std::vector<std::vector<Point>> grains {
        { { 0.66895204823138067, 2.8828715344781028 }, { 1.848918304483933, 4.2298293642198826 },
            { 2.2346312713331855, 6.7011858252376761 },
            { 0.14276938955791593, 6.762576562245666 } },
        { { 0.0, 10.494963894467479 }, { 6.2271632385139516, 13.739550949019498 },
            { 0.0, 18.773773293852998 } },
    };
    for (const auto& grain : grains) {
        const double whole = polygon_shape(grain).area;
        double total = 0.0;
        for (const auto& cell : relax_seeds(grain, 3).cells) {
            std::vector<Point> corners;
            for (const InnerCorner& c : cell)
                corners.push_back(c.point);
            REQUIRE(corners.size() >= 3);
            const double area = polygon_shape(corners).area;
            CHECK(area == Approx(whole / 3.0).epsilon(0.3));
            total += area;
        }
        CHECK(total == Approx(whole).epsilon(1e-13));
    }
}

TEST_CASE(
    "a cell's neighbour has the cell as its neighbour; each edge of the grain has cells", "[inner]")
{
    const InnerPacking packing = relax_seeds(dented, 20);
    std::set<int> edges;
    for (int i = 0; i < 20; ++i) {
        for (const InnerCorner& c : packing.cells[i]) {
            if (c.beyond.is_edge()) {
                edges.insert(c.beyond.index);
                continue;
            }
            const auto& other = packing.cells[c.beyond.index];
            CHECK(std::any_of(other.begin(), other.end(), [i](const InnerCorner& o) {
                return o.beyond == Beyond { Beyond::Kind::seed, i };
            }));
        }
    }
    CHECK(edges == std::set<int> { 0, 1, 2, 3, 4 });
}
