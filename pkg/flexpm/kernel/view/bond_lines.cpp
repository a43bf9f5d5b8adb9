// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/view/bond_lines.hpp>

#include <flexpm/kernel/fem/edge_points.hpp>
#include <flexpm/kernel/view/snapshot.hpp>

#include <numeric>

namespace flexpm {

Line point_line(const Assembly& a, int contact, int point, double factor)
{
    const Point start = contact_end(a, contact, 0, factor);
    const Point along = contact_end(a, contact, 1, factor) - start;
    const auto share = edge_points(a.contacts.points_of(contact)).share;
    const double from = std::accumulate(share.begin(), share.begin() + point, 0.0);
    return { start + from * along, start + (from + share[point]) * along };
}

}  // namespace flexpm
