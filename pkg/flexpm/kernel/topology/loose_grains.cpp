// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/topology/loose_grains.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/assembly/loose_groups.hpp>
#include <flexpm/kernel/topology/contact_update.hpp>

#include <algorithm>
#include <vector>

namespace flexpm {

namespace {

bool presses_any(const Assembly& a)
{
    const auto& pressure = a.facets.pressure;
    return std::any_of(pressure.begin(), pressure.end(), [](double p) { return p != 0.0; })
        || loads_any(a.plates);
}

bool is_held(const Grains& grains, int grain)
{
    bool held = grains.is_rigid(grain) && grains.spin_prescribed[grains.slot[grain]];
    for_each_component(grains, grain, [&](int i) { held = held || grains.prescribed[i]; });
    return held;
}

std::vector<std::uint8_t> held_grains(const Assembly& a)
{
    std::vector<std::uint8_t> held(a.grains.count, 0);
    for (int g = 0; g < a.grains.count; ++g)
        held[g] = !a.grains.erased[g] && is_held(a.grains, g);
    mark_touching(a.plates, a.facets.grain, held);
    return held;
}

}  // namespace

void find_loose(Assembly& a)
{
    std::fill(a.grains.loose.begin(), a.grains.loose.end(), 0);
    if (!presses_any(a)) return;
    Groups groups(a.grains.count);
    for (int c = 0; c < a.contacts.count; ++c) {
        if (joins(a, c)) groups.join(a.contacts.pairs[c][0], a.contacts.pairs[c][1]);
    }
    mark_loose(a.grains, groups, held_grains(a));
}

}  // namespace flexpm
