// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/view/bond_lines.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/fem/edge_points.hpp>

#include <algorithm>
#include <numeric>

namespace flexpm {

namespace {

/// End of the part of the edges on which a contact acts, in the middle between both grains.
Point drawn_end(const Assembly& a, int contact, int end, double factor)
{
    Point sum;
    for (int side = 0; side < 2; ++side) {
        const auto [from, to] = a.contacts.edge(contact, side);
        const double share = acting_part(a, contact, side)[end];
        sum = sum
            + 0.5
                * ((1.0 - share) * a.grains.point_at(from, factor)
                    + share * a.grains.point_at(to, factor));
    }
    return sum;
}

}  // namespace

Line point_line(const Assembly& a, int contact, int point, double factor)
{
    const Point start = drawn_end(a, contact, 0, factor);
    const Point along = drawn_end(a, contact, 1, factor) - start;
    const auto share = edge_points(a.contacts.points_of(contact)).share;
    const double from = std::accumulate(share.begin(), share.begin() + point, 0.0);
    return { start + from * along, start + (from + share[point]) * along };
}

Line branch_line(const Assembly& a, int contact, double factor)
{
    const auto centre = [&](int side) {
        const int grain = a.contacts.pairs[contact][side];
        return a.grains.point_at(a.grains.centre(grain), factor);
    };
    return { centre(0), centre(1) };
}

}  // namespace flexpm
