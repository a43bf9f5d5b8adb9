// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Values of the laws of bonds, strengths among them, over a specimen of several minerals:
/// the lowest that counts, and the one that no crack through the specimen stays below.
#pragma once

#include <array>
#include <vector>

namespace flexpm {

/// A bond by a value of its law.
struct BondValue {
    double value = 0.0;
    double area = 0.0;  ///< [m^2]
    std::array<int, 2> grains {};
};

/// Values on less than this share of the bonded area do not count as the lowest [-].
constexpr double least_bond_share = 0.01;

/// Smallest value that bonds on `least_bond_share` of the area do not exceed.
/// @param bonds  at least one
double lowest_value(std::vector<BondValue> bonds);

/// Largest value such that the bonds that reach it connect at least half of the grains that all
/// bonds connect. A crack that divides the specimen breaks bonds of this strength.
/// @param bonds  at least one
double connecting_value(std::vector<BondValue> bonds, int grains);

/// Value of the law of each pair of kinds of grains that the bonds join, before strengths of single
/// bonds multiply it. Grains without a bond count with their own law.
///
/// @param counts  whether the bond of an index is one of the rock's, counts(contact)
/// @param value   of a law, value(law)
template <class State, class Counts, class Value>
std::vector<BondValue> bond_values(const State& s, const Counts& counts, const Value& value)
{
    const auto law = [&](int a, int b) { return value(s.contacts.laws[s.grains.law_index(a, b)]); };
    std::vector<BondValue> found;
    for (int c = 0; c < s.contacts.count; ++c) {
        if (!counts(c)) continue;
        const auto pair = s.contacts.pairs[c];
        double area = 0.0;
        for (int p = 0; p < s.contacts.points_of(c); ++p)
            area += s.contacts.area(c, p);
        found.push_back({ law(pair[0], pair[1]), area, { pair[0], pair[1] } });
    }
    if (found.empty()) {
        for (int g = 0; g < s.grains.count; ++g)
            found.push_back({ law(g, g), 1.0, { g, g } });
    }
    return found;
}

}  // namespace flexpm
