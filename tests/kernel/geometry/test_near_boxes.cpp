// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Pairs of boxes that meet, against a look at each pair.
#include "support/catch.hpp"

#include <flexpm/kernel/core/random.hpp>
#include <flexpm/kernel/geometry/near_boxes.hpp>

#include <limits>

using namespace flexpm;

namespace {

std::vector<std::array<int, 2>> all_pairs(const std::vector<AxisBox>& boxes)
{
    std::vector<std::array<int, 2>> pairs;
    const auto meet = [](double low, double high, double other_low, double other_high) {
        return low <= other_high && other_low <= high;
    };
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        for (std::size_t k = i + 1; k < boxes.size(); ++k) {
            const AxisBox &a = boxes[i], &b = boxes[k];
            if (meet(a.low.x, a.high.x, b.low.x, b.high.x)
                && meet(a.low.y, a.high.y, b.low.y, b.high.y)
                && meet(a.low.z, a.high.z, b.low.z, b.high.z))
                pairs.push_back({ static_cast<int>(i), static_cast<int>(k) });
        }
    }
    return pairs;
}

}  // namespace

TEST_CASE("Boxes that meet are found once each, in order", "[pairs]")
{
    Random random(7);
    const auto draw = [&](double size) { return size * (random.next() - 0.5); };
    for (int round = 0; round < 50; ++round) {
        std::vector<AxisBox> boxes;
        const double room = 1.0 + 20.0 * random.next();
        for (int i = 0; i < 60; ++i) {
            const double x = draw(room), y = draw(room), z = draw(round % 2 == 0 ? room : 0.0);
            const double wide = 0.1 + random.next(), deep = random.next(), high = random.next();
            boxes.push_back({ { x, y, z }, { x + wide, y + deep, z + high } });
        }
        CHECK(meeting_boxes(boxes) == all_pairs(boxes));
    }
}

TEST_CASE("Boxes far away are found, and those nowhere are not", "[pairs]")
{
    const AxisBox unit { { 0.0, 0.0, 0.0 }, { 1.0, 1.0, 1.0 } };
    const auto moved = [&](Vector by) { return AxisBox { unit.low + by, unit.high + by }; };
    const double far = 1e12, infinite = std::numeric_limits<double>::infinity();
    std::vector<AxisBox> boxes { unit, moved({ far, 0.0, 0.0 }), moved({ far, 0.5, 0.0 }),
        moved({ -far, -far, far }), moved({ std::nan(""), 0.0, 0.0 }),
        moved({ infinite, 0.0, 0.0 }), moved({ 1.0, 1.0, 1.0 }) };
    CHECK(meeting_boxes(boxes) == std::vector<std::array<int, 2>> { { 0, 6 }, { 1, 2 } });
    CHECK(meeting_boxes({}).empty());
    // points have no edge
    CHECK(meeting_boxes({ { {}, {} }, { {}, {} } }).size() == 1);
}
