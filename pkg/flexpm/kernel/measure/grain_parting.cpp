// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/measure/grain_parting.hpp>

#include <algorithm>

namespace flexpm {

namespace {

double parted_by(const Grains& grains, GrainPair pair)
{
    const int a = grains.centre(pair[0]), b = grains.centre(pair[1]);
    return norm(grains.point_at(b) - grains.point_at(a))
        - norm(grains.reference_at(b) - grains.reference_at(a));
}

}  // namespace

Parting find_parting(const Assembly& a)
{
    const Grains& grains = a.grains;
    Parting found;
    for (int c = 0; c < a.contacts.count; ++c) {
        const auto [first, second] = a.contacts.pairs[c];
        if (!a.contacts.bonded[c] || grains.erased[first] || grains.erased[second]) continue;
        const double way = parted_by(grains, a.contacts.pairs[c]);
        found.any = std::max(found.any, way);
        if (!grains.loose[first] && !grains.loose[second])
            found.standing = std::max(found.standing, way);
    }
    found.loose = static_cast<int>(std::count(grains.loose.begin(), grains.loose.end(), 1));
    return found;
}

}  // namespace flexpm
