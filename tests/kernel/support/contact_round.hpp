// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  One look at the contacts of an assembly, as a solver takes it every so many steps.
#pragma once

#include <flexpm/kernel/topology/contact_search.hpp>
#include <flexpm/kernel/topology/contact_update.hpp>
#include <flexpm/kernel/topology/crack_faces.hpp>

#include <vector>

namespace contact_round {

/// End contacts that are over, begin those of discs that touch.
inline void update_contacts(flexpm::Assembly& a)
{
    flexpm::follow_faces(a, 0.0, 1.0);
    flexpm::follow_cracks(a, 0.0, 1.0);
    flexpm::follow_touches(a, 0.0, 1.0);
    std::vector<int> over;
    for (int c = 0; c < a.contacts.count; ++c) {
        if (flexpm::is_active(a.contacts, c) && flexpm::has_ended(a, c)) over.push_back(c);
    }
    std::vector<flexpm::GrainPair> touching;
    for (const flexpm::GrainPair& pair : flexpm::near_pairs(a, 1e-4)) {
        if (flexpm::is_touching(a, pair)) touching.push_back(pair);
    }
    flexpm::change_contacts(a, over, touching, 0.0, 1.0);
}

}  // namespace contact_round
