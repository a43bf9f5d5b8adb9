// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/geometry/near_boxes.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace flexpm {

namespace {

/// Cells of a grid, numbered along x first. Each has the edge of the largest box, so that boxes that
/// meet have their centres in the same cell or in neighbours. Cells beyond the last one are taken as
/// the last one, which keeps neighbours together.
class Cells {
public:
    explicit Cells(const std::vector<AxisBox>& boxes)
    {
        for (const AxisBox& b : boxes) {
            if (!is_sound(b)) continue;
            const Vector size = b.high - b.low;
            edge = std::max({ edge, size.x, size.y, size.z });
        }
    }

    static bool is_sound(const AxisBox& b) { return is_finite(b.low) && is_finite(b.high); }

    std::array<std::int64_t, 3> cell(const AxisBox& b) const
    {
        const Vector middle = 0.5 * (b.low + b.high);
        const auto along = [this](double at) {
            const double cells = edge > 0.0 ? std::floor(at / edge) : 0.0;
            return static_cast<std::int64_t>(std::clamp(cells, -last, last)) + offset;
        };
        return { along(middle.x), along(middle.y), along(middle.z) };
    }

    static std::int64_t number(std::int64_t x, std::int64_t y, std::int64_t z)
    {
        return (z << 2 * bits) + (y << bits) + x;
    }

private:
    static constexpr int bits = 20;
    /// Neighbours of the last cells have numbers, too.
    static constexpr double last = (1 << (bits - 1)) - 2;
    static constexpr std::int64_t offset = 1 << (bits - 1);
    double edge = 0.0;
};

bool meet(const AxisBox& a, const AxisBox& b)
{
    return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y
        && a.low.z <= b.high.z && b.low.z <= a.high.z;
}

}  // namespace

std::vector<std::array<int, 2>> meeting_boxes(const std::vector<AxisBox>& boxes)
{
    const Cells cells(boxes);
    struct Entry {
        std::int64_t cell;
        int box;
    };
    std::vector<Entry> entries;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        if (!Cells::is_sound(boxes[i])) continue;
        const auto [x, y, z] = cells.cell(boxes[i]);
        entries.push_back({ Cells::number(x, y, z), static_cast<int>(i) });
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
        return a.cell < b.cell || (a.cell == b.cell && a.box < b.box);
    });
    const auto before = [](const Entry& e, std::int64_t cell) { return e.cell < cell; };
    std::vector<std::array<int, 2>> pairs;
    for (const Entry& own : entries) {
        const auto [x, y, z] = cells.cell(boxes[own.box]);
        for (int k = -1; k <= 1; ++k) {
            for (int j = -1; j <= 1; ++j) {
                const std::int64_t first = Cells::number(x - 1, y + j, z + k);
                auto at = std::lower_bound(entries.begin(), entries.end(), first, before);
                for (; at != entries.end() && at->cell <= first + 2; ++at) {
                    if (at->box > own.box && meet(boxes[own.box], boxes[at->box]))
                        pairs.push_back({ own.box, at->box });
                }
            }
        }
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

}  // namespace flexpm
