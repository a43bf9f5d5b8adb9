// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Seeds of inner particles in one grain, relaxed until their cells have equal areas, paper
/// Sec. 4.1.
#pragma once

#include <flexpm/kernel/core/vector.hpp>

#include <vector>

namespace flexpm {

/// What lies on the other side of an edge of a small cell.
struct Beyond {
    enum class Kind { seed, edge };
    Kind kind;
    int index;  ///< of the other seed, or of the edge of the polygon: edge k starts at corner k

    bool is_seed() const { return kind == Kind::seed; }
    bool is_edge() const { return kind == Kind::edge; }
};
inline bool operator==(Beyond a, Beyond b) { return a.kind == b.kind && a.index == b.index; }
inline bool operator!=(Beyond a, Beyond b) { return !(a == b); }

/// A corner of a small cell.
struct InnerCorner {
    Point point;
    Beyond beyond;  ///< the edge that starts here
};

/// Seeds of a polygon, relaxed until their power cells have equal areas, and those cells.
struct InnerPacking {
    std::vector<Point> seeds;
    std::vector<std::vector<InnerCorner>> cells;  ///< counter-clockwise
};

/// Relax seeds until the areas of their cells agree to 1 % of the mean, in most polygons much
/// better. The result depends on the polygon and the count alone.
/// @param polygon  counter-clockwise, star-shaped
InnerPacking relax_seeds(const std::vector<Point>& polygon, int count);

}  // namespace flexpm
