// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/topology/loose_grains.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/assembly/loose_groups.hpp>
#include <flexpm/kernel/space_lanes/solid_access.hpp>
#include <flexpm/kernel/topology/contact_update.hpp>

#include <algorithm>
#include <vector>

namespace flexpm {

namespace {

/// Whether any point of a contact has its bond, or is closed.
bool joins(const SolidState& s, int contact)
{
    const FaceContacts& c = s.contacts;
    if (c.has_ended(contact)) return false;
    if (!is_cracked_through(c, contact)) return true;
    const std::vector<FacePlace> places = places_of(s, contact);
    for (int p = 0; p < c.points_of(contact); ++p)
        if (c.area(contact, p) > 0.0 && places[p].opening <= 0.0) return true;
    return false;
}

template <class State> bool presses_any(const State& s)
{
    const std::vector<double>& pressure = s.pressures();
    return std::any_of(pressure.begin(), pressure.end(), [](double p) { return p != 0.0; })
        || loads_any(s.plates);
}

/// Whether anything moves what has come loose as it should not.
bool moves_loose(const Assembly& a) { return presses_any(a); }
bool moves_loose(const SolidState& s) { return presses_any(s) || s.has_gravity(); }

/// Pairs of grains without a common face hang together while they press.
void join_pairs(const Assembly&, Groups&) { }
void join_pairs(const SolidState& s, Groups& groups)
{
    for (const PairContact& pair : s.pairs)
        if (pair.presses()) groups.join(pair.grains[0], pair.grains[1]);
}

template <class State> bool is_held(const State& s, int grain)
{
    bool held = s.is_spin_held(grain);
    for_each_component(s.grains, grain, [&](int i) { held = held || s.grains.prescribed[i] != 0; });
    return held;
}

template <class State> std::vector<std::uint8_t> held_grains(const State& s)
{
    std::vector<std::uint8_t> held(s.grains.count, 0);
    for (int g = 0; g < s.grains.count; ++g)
        held[g] = !s.grains.erased[g] && is_held(s, g);
    mark_touching(s.plates, s.facet_grains(), held);
    return held;
}

}  // namespace

template <class State> void find_loose(State& s)
{
    std::fill(s.grains.loose.begin(), s.grains.loose.end(), 0);
    if (!moves_loose(s)) return;
    Groups groups(s.grains.count);
    for (int c = 0; c < s.contacts.count; ++c) {
        if (joins(s, c)) groups.join(s.contacts.pairs[c][0], s.contacts.pairs[c][1]);
    }
    join_pairs(s, groups);
    mark_loose(s.grains, groups, held_grains(s));
}

template void find_loose(Assembly& s);
template void find_loose(SolidState& s);

}  // namespace flexpm
