// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Powers of points with respect to discs: the metric of Laguerre cells, paper Sec. 3.1.
#pragma once

#include <flexpm/kernel/core/vector.hpp>

namespace flexpm {

/// Power of a point with respect to a disc.
inline double power(Point p, const Disc& d)
{
    const Point from = p - d.centre;
    return dot(from, from) - d.radius * d.radius;
}

/// Point of equal power of three discs. Coordinates are relative to the first disc, so that no
/// digits are lost far from the origin.
inline Point radical_centre(const Disc& a, const Disc& b, const Disc& c)
{
    const Point to_b = b.centre - a.centre, to_c = c.centre - a.centre;
    const double pb = 0.5 * (dot(to_b, to_b) + a.radius * a.radius - b.radius * b.radius);
    const double pc = 0.5 * (dot(to_c, to_c) + a.radius * a.radius - c.radius * c.radius);
    const double det = cross(to_b, to_c);
    return { a.centre.x + (pb * to_c.y - pc * to_b.y) / det,
        a.centre.y + (to_b.x * pc - to_c.x * pb) / det };
}

}  // namespace flexpm
