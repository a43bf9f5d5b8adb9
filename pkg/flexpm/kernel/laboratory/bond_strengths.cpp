// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/bond_strengths.hpp>

#include <flexpm/kernel/core/groups.hpp>

#include <algorithm>
#include <cstddef>

namespace flexpm {

namespace {

template <class Before> void sort(std::vector<BondValue>& bonds, const Before& before)
{
    std::stable_sort(bonds.begin(), bonds.end(),
        [&](const BondValue& one, const BondValue& two) { return before(one.value, two.value); });
}

int largest_group(Groups& groups, int grains)
{
    std::vector<int> sizes(grains, 0);
    for (int g = 0; g < grains; ++g)
        ++sizes[groups.of(g)];
    return *std::max_element(sizes.begin(), sizes.end());
}

}  // namespace

double lowest_value(std::vector<BondValue> bonds)
{
    sort(bonds, [](double one, double two) { return one < two; });
    double area = 0.0, passed = 0.0;
    for (const BondValue& bond : bonds)
        area += bond.area;
    for (const BondValue& bond : bonds) {
        passed += bond.area;
        if (passed >= least_bond_share * area) return bond.value;
    }
    return bonds.back().value;
}

double connecting_value(std::vector<BondValue> bonds, int grains)
{
    sort(bonds, [](double one, double two) { return one > two; });
    Groups all(grains), groups(grains);
    for (const BondValue& bond : bonds)
        all.join(bond.grains[0], bond.grains[1]);
    const int connected = largest_group(all, grains);
    for (std::size_t b = 0; b < bonds.size(); ++b) {
        groups.join(bonds[b].grains[0], bonds[b].grains[1]);
        if (b + 1 < bonds.size() && bonds[b + 1].value == bonds[b].value) continue;
        if (2 * largest_group(groups, grains) >= connected) return bonds[b].value;
    }
    return bonds.back().value;
}

}  // namespace flexpm
