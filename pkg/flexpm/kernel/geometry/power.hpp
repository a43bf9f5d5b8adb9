// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Powers of points with respect to discs: the metric of Laguerre cells, paper Sec. 3.1.
#pragma once

#include <flexpm/kernel/core/types.hpp>

namespace flexpm {

/// Power of a point with respect to a disc.
inline double power(Point p, const Disc& d)
{
    const double dx = p.x - d.centre.x, dy = p.y - d.centre.y;
    return dx * dx + dy * dy - d.radius * d.radius;
}

/// Point of equal power of three discs; relative to the first, so that large offsets cost nothing.
inline Point radical_centre(const Disc& a, const Disc& b, const Disc& c)
{
    const double bx = b.centre.x - a.centre.x, by = b.centre.y - a.centre.y;
    const double cx = c.centre.x - a.centre.x, cy = c.centre.y - a.centre.y;
    const double pb = 0.5 * (bx * bx + by * by + a.radius * a.radius - b.radius * b.radius);
    const double pc = 0.5 * (cx * cx + cy * cy + a.radius * a.radius - c.radius * c.radius);
    const double det = bx * cy - by * cx;
    return { a.centre.x + (pb * cy - pc * by) / det, a.centre.y + (bx * pc - cx * pb) / det };
}

}  // namespace flexpm
