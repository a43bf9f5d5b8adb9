// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  A rectangle of random grains between ends, as its loading begins. SI units.
#pragma once

#include <flexpm/kernel/laboratory/end_displacement.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/step/step.hpp>

#include "support/specimens.hpp"

namespace gripped {

/// Random grains, gripped and driven at `velocity`, the energies counted.
inline flexpm::Assembly grains(double velocity)
{
    flexpm::Assembly a =
        specimens::assemble(specimens::random_grains(0.02, 0.04, 2.8e-3, 3), specimens::options());
    flexpm::scale_masses(a, 0.7);
    flexpm::grip_bottom(a);
    flexpm::move_top(a, velocity);
    flexpm::reset_energy_balance(a);
    return a;
}

inline flexpm::StepOptions measured()
{
    flexpm::StepOptions o;
    o.measure = true;
    return o;
}

inline void run(flexpm::Assembly& a, int count)
{
    for (int i = 0; i < count; ++i)
        flexpm::step(a, measured());
}

}  // namespace gripped
