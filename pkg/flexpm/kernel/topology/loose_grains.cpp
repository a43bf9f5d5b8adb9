// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/topology/loose_grains.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/groups.hpp>
#include <flexpm/kernel/topology/contact_update.hpp>

#include <algorithm>
#include <vector>

namespace flexpm {

namespace {

bool presses_any(const Assembly& a)
{
    const auto& pressure = a.facets.pressure;
    return std::any_of(pressure.begin(), pressure.end(), [](double p) { return p != 0.0; })
        || std::any_of(a.plates.begin(), a.plates.end(), [](const Plate& p) { return p.loaded; });
}

bool is_held(const Grains& grains, int grain)
{
    bool held = grains.is_rigid(grain) && grains.spin_prescribed[grains.slot[grain]];
    for_each_component(grains, grain, [&](int i) { held = held || grains.prescribed[i]; });
    return held;
}

/// Mark the grains that touch a plate.
void mark_touching(const Assembly& a, const Plate& plate, std::vector<std::uint8_t>& marked)
{
    for (std::size_t i = 0; i < plate.opening.size(); ++i) {
        if (plate.area[i] > 0.0 && (plate.bonded || plate.opening[i] <= 0.0))
            marked[a.facets.grain[plate.facets[i / plate.points]]] = 1;
    }
}

std::vector<std::uint8_t> held_grains(const Assembly& a)
{
    std::vector<std::uint8_t> held(a.grains.count, 0);
    for (int g = 0; g < a.grains.count; ++g)
        held[g] = !a.grains.erased[g] && is_held(a.grains, g);
    for (const Plate& plate : a.plates) {
        if (!plate.loaded) mark_touching(a, plate, held);
    }
    return held;
}

/// The group whose discs have the largest area.
int largest_group(const Grains& grains, Groups& groups)
{
    std::vector<double> area(grains.count, 0.0);
    for (int g = 0; g < grains.count; ++g) {
        if (!grains.erased[g]) area[groups.of(g)] += grains.radius[g] * grains.radius[g];
    }
    return static_cast<int>(std::max_element(area.begin(), area.end()) - area.begin());
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
    const std::vector<std::uint8_t> held = held_grains(a);
    std::vector<std::uint8_t> stands(a.grains.count, 0);  // by group
    for (int g = 0; g < a.grains.count; ++g) {
        if (held[g]) stands[groups.of(g)] = 1;
    }
    if (std::find(stands.begin(), stands.end(), 1) == stands.end())
        stands[largest_group(a.grains, groups)] = 1;
    for (int g = 0; g < a.grains.count; ++g)
        a.grains.loose[g] = !a.grains.erased[g] && !stands[groups.of(g)];
}

}  // namespace flexpm
