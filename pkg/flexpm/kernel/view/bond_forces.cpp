// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/view/bond_forces.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/space_lanes/solid_access.hpp>

#include <algorithm>
#include <type_traits>

namespace flexpm {

namespace {

/// Force of a contact on its second grain, and its normal from the first grain to the second.
template <class State> Vector force_of(const State& s, int contact)
{
    if constexpr (std::is_same_v<State, Assembly>)
        return contact_force(s.contacts, contact);
    else
        return contact_force(s, contact);
}
template <class State> Vector unit_normal(const State& s, int contact)
{
    if constexpr (std::is_same_v<State, Assembly>)
        return s.contacts.normal(contact);
    else
        return contact_normal(s, contact);
}

}  // namespace

std::array<Vector, 2> branch_line(const Grains& grains, GrainPair pair, double factor)
{
    return { grains.position(grains.centre(pair[0]), factor),
        grains.position(grains.centre(pair[1]), factor) };
}

template <class State> double normal_force(const State& s, int contact)
{
    // the force on the second grain points back to the first in tension
    return -dot(force_of(s, contact), unit_normal(s, contact));
}

template <class State> double largest_contact_force(const State& s)
{
    double largest = 0.0;
    for (int c = 0; c < s.contacts.count; ++c)
        largest = std::max(largest, s.grains.length(force_of(s, c)));
    return largest;
}

template double normal_force(const Assembly&, int);
template double normal_force(const SolidState&, int);
template double largest_contact_force(const Assembly&);
template double largest_contact_force(const SolidState&);

}  // namespace flexpm
