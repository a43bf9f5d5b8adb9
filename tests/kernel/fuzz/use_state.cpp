// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/use_state.hpp"

#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/step/step.hpp>
#include <flexpm/kernel/topology/erasure.hpp>
#include <flexpm/kernel/view/snapshot.hpp>

#include "support/contact_round.hpp"

namespace fuzz {

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
    contact_round::update_contacts(a);
    flexpm::step(a, o);
    if (a.grains.count > 1) flexpm::erase(a, { { 1 }, {} }, 1.0);
    flexpm::step(a, o);
    flexpm::take_snapshot(a);
}

}  // namespace fuzz
