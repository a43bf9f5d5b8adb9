// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Pairs of grains that may come to touch, paper Sec. 2.3. SI units.
#pragma once

#include <flexpm/kernel/topology/contact_update.hpp>

#include <vector>

namespace flexpm {

/// Pairs of grains that are there, whose discs are less than `margin` apart and that no contact
/// holds, ascending. They follow from the positions alone, so a loaded state finds the same pairs.
std::vector<GrainPair> near_pairs(const Assembly& a, double margin);

/// The same pairs again and again while grains move little: pairs of a wider margin are kept and
/// searched anew only once a grain has moved by a quarter of the margin.
class NearPairs {
public:
    /// What near_pairs() gives.
    const std::vector<GrainPair>& find(const Assembly& a, double margin);

    /// Search anew the next time: contacts have come or gone.
    void forget() { from.clear(); }

private:
    std::vector<GrainPair> watched, near;
    std::vector<Point> from;  ///< centres at the last search [m]
    double watched_margin = 0.0;
};

}  // namespace flexpm
