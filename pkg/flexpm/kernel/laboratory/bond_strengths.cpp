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

/// Grains in groups, and the size of the largest group.
class SizedGroups {
public:
    explicit SizedGroups(int grains) : groups(grains), sizes(grains, 1) { }

    void join(const std::array<int, 2>& grains)
    {
        const int one = groups.of(grains[0]), other = groups.of(grains[1]);
        if (one == other) return;
        groups.join(one, other);
        const int size = sizes[one] + sizes[other];
        sizes[groups.of(one)] = size;
        largest = std::max(largest, size);
    }

    int largest = 1;

private:
    Groups groups;
    std::vector<int> sizes;  ///< of each group, at the grain that stands for it
};

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
    SizedGroups all(grains), groups(grains);
    for (const BondValue& bond : bonds)
        all.join(bond.grains);
    for (std::size_t b = 0; b < bonds.size(); ++b) {
        groups.join(bonds[b].grains);
        if (b + 1 < bonds.size() && bonds[b + 1].value == bonds[b].value) continue;
        if (2 * groups.largest >= all.largest) return bonds[b].value;
    }
    return bonds.back().value;
}

}  // namespace flexpm
