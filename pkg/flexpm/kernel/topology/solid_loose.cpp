// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/topology/solid_loose.hpp>

#include <flexpm/kernel/assembly/loose_groups.hpp>
#include <flexpm/kernel/space_lanes/solid_access.hpp>
#include <flexpm/kernel/forces/solid_pressure.hpp>

#include <algorithm>
#include <vector>

namespace flexpm {

namespace {

/// Whether any point of a contact has its bond, or bears pressure.
bool joins(const SolidState& s, int contact)
{
    const FaceContacts& c = s.contacts;
    const auto counts = [&](int p) { return c.area(contact, p) > 0.0; };
    for (int p = 0; p < c.points_of(contact); ++p)
        if (counts(p) && c.crack(contact, p).mode == intact) return true;
    const std::vector<FacePlace> places = places_of(s, contact);
    for (int p = 0; p < c.points_of(contact); ++p)
        if (counts(p) && places[p].opening < 0.0) return true;
    return false;
}

std::vector<std::uint8_t> held_grains(const SolidState& s)
{
    const Grains& grains = s.grains;
    std::vector<std::uint8_t> held(grains.count, 0);
    for (int g = 0; g < grains.count; ++g)
        held[g] = grains.is_rigid(g) && s.bodies[g].spin_held;
    for_each_node(s, [&](int grain, int number) {
        for (int axis = 0; axis < grains.layout.dimension; ++axis)
            if (grains.prescribed[grains.component(grains.node(grain, number), axis)])
                held[grain] = 1;
    });
    mark_touching(s.plates, s.surface.grain, held);
    return held;
}

}  // namespace

void find_loose(SolidState& s)
{
    std::vector<std::uint8_t>& loose = s.grains.loose;
    std::fill(loose.begin(), loose.end(), 0);
    if (!is_pressed(s) && !loads_any(s.plates)) return;
    Groups groups(s.grains.count);
    for (int c = 0; c < s.contacts.count; ++c)
        if (joins(s, c)) groups.join(s.contacts.pairs[c][0], s.contacts.pairs[c][1]);
    mark_loose(s.grains, groups, held_grains(s));
}

}  // namespace flexpm
