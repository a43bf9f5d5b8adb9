// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Grains that fit together and are not bonded.
#pragma once

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/space_lanes/solid_access.hpp>

namespace flexpm {

/// Take the strength of all points of a contact. Such a contact never counts as a crack.
template <class ContactList> void crack_from_start(ContactList& contacts, int contact)
{
    for (int p = 0; p < contacts.points_of(contact); ++p)
        take_strength(contacts, contact, p);
}

/// The same of all contacts of grains at rest: they press on each other and rub.
template <class State> void crack_all_from_start(State& s)
{
    for (int contact = 0; contact < s.contacts.count; ++contact)
        crack_from_start(s.contacts, contact);
}

}  // namespace flexpm
