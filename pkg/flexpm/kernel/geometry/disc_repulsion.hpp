// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Two discs or spheres of a packing that push each other apart in proportion to their
/// overlap, paper Sec. 3.1. Lengths in mean diameters, stiffness and mass without units.
#pragma once

#include <flexpm/kernel/core/space_vector.hpp>

#include <cmath>

namespace flexpm {

/// State of two discs, valid as long as they keep touching or keep apart.
struct DiscPair {
    double radius_sum = 0.0;
    double stiffness = 0.0;  ///< force over overlap
    bool touching = false;
};

/// Result of a pair in a step.
struct PairPush {
    bool changes = false;  ///< the pair begins or ceases to touch: the push is not given
    Vector push;           ///< force on the second disc, the first takes the opposite; 0 if apart
};

/// Push between the discs at `first` and `second`. The order of operations is that of YADE's
/// spheres, to the last bit, so that a packing does not depend on which of the two computed it.
inline PairPush push_apart(const DiscPair& pair, Vector first, Vector second)
{
    const Vector apart = second - first;
    const double square = apart.x * apart.x + (apart.y * apart.y + apart.z * apart.z);
    if (!pair.touching) {
        // pairs within rounding of touching are left to the code that decides
        constexpr double rounding = 1e-12;
        return { square <= pair.radius_sum * pair.radius_sum * (1.0 + rounding), {} };
    }
    const double distance = std::sqrt(square);
    const double overlap = pair.radius_sum - distance;
    if (overlap < 0.0) return { true, {} };
    const double force = pair.stiffness * overlap;
    return { false,
        { force * (apart.x / distance), force * (apart.y / distance),
            force * (apart.z / distance) } };
}

}  // namespace flexpm
