// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/use_state.hpp"

#include <flexpm/kernel/assembly/snapshot.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/step/step.hpp>
#include <flexpm/kernel/topology/contact_search.hpp>
#include <flexpm/kernel/topology/contact_update.hpp>
#include <flexpm/kernel/topology/erasure.hpp>

#include <vector>

namespace fuzz {

namespace {

void change_contacts(flexpm::Assembly& a)
{
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

}  // namespace

void use_state(flexpm::Assembly& a)
{
    flexpm::StepOptions o;
    o.measure = true;
    for (int i = 0; i < 3; ++i)
        flexpm::step(a, o);
    flexpm::energies(a);
    flexpm::unbalanced_ratio(a);
    flexpm::count_cracks(a);
    flexpm::find_bad_number(a);
    flexpm::take_snapshot(a);
    for (int side = 0; side < 4; ++side)
        flexpm::side_nodes(a, side);
    flexpm::stable_step(a, 0.5);
    change_contacts(a);
    flexpm::step(a, o);
    if (a.grains.count > 1) flexpm::erase(a, { { 1 }, {} }, 1.0);
    flexpm::step(a, o);
    flexpm::take_snapshot(a);
}

}  // namespace fuzz
