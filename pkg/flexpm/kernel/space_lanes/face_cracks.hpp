// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Points of faces that lose their bonds in a step.
#pragma once

#include <flexpm/kernel/assembly/solid_state.hpp>

#include <cstdint>

namespace flexpm {

/// Points of a face: the corners and one inside, or as many.
constexpr int most_points = most_corners + 1;

/// Points of a block that have cracked in a step.
class FreshCracks {
public:
    void add(int point, int lane, double opening)
    {
        ++count;
        cracked[point * lanes + lane] = 1;
        openings[point * lanes + lane] = opening;
    }

    bool any() const { return count > 0; }
    bool has(int point, int lane) const { return cracked[point * lanes + lane] != 0; }
    /// Since it was bonded [m].
    double opening(int point, int lane) const { return openings[point * lanes + lane]; }

private:
    int count = 0;
    std::uint8_t cracked[most_points * lanes] = {};
    double openings[most_points * lanes];
};

/// Record when, how and where points of a block of contacts have cracked.
void record_cracks(SolidState& s, int block, const FreshCracks& cracks);

}  // namespace flexpm
