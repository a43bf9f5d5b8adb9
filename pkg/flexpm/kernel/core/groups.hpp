// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Things that hang together: disjoint sets.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

namespace flexpm {

/// Grains that contacts join; each group has the number of its first grain.
class Groups {
public:
    explicit Groups(int grains) : first(grains) { std::iota(first.begin(), first.end(), 0); }

    int of(int grain)
    {
        while (first[grain] != grain)
            grain = first[grain] = first[first[grain]];
        return grain;
    }

    void join(int a, int b)
    {
        const int i = of(a), j = of(b);
        first[std::max(i, j)] = std::min(i, j);
    }

private:
    std::vector<int> first;
};

}  // namespace flexpm
