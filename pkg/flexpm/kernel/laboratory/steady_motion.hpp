// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Motion that goes on steadily while a specimen comes down from its peak, deviation D55:
/// damping does not act on it.
///
/// Grains that slide down are shaken by the cracks around them. The damping of Eq. 2 opposes the
/// velocity of each node by a share of its force, which the shaking makes large, so that it drags
/// on a slow motion like a thick fluid and holds the specimen together. What damping leaves alone
/// is therefore the mean motion since the last look, that of the loading among it; what nodes move
/// beyond it is damped as ever. SI units.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>
#include <flexpm/kernel/assembly/solid_state.hpp>

namespace flexpm {

/// Let damping leave alone the mean motion since the last look, from the second look on. Loose
/// grains have no part in the descent: all of their motion is damped (deviation D57).
///
/// @param dt       time step [s]
/// @param fastest  of that motion [m/s]; the rim of a rigid grain turns no faster
template <class State> void follow_steady_motion(State& s, double dt, double fastest);

extern template void follow_steady_motion(Assembly& s, double dt, double fastest);
extern template void follow_steady_motion(SolidState& s, double dt, double fastest);

/// Let it leave alone that of the loading again.
void end_steady_motion(BondedState& s);

}  // namespace flexpm
