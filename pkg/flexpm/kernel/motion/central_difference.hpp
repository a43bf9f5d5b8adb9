// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Central differences with local damping for one degree of freedom, paper Eqs. 1-3, and the
/// books of its energy.
#pragma once

#include <flexpm/kernel/core/array.hpp>
#include <flexpm/kernel/core/compiler.hpp>

#include <algorithm>
#include <cmath>

namespace flexpm {

/// Sums over the degrees of freedom of a block, [lane] [J]; `next` belongs to the half step after.
/// Cleared and copied by loops over lanes: of a whole struct the compiler makes slow string instructions.
struct StepSums {
    alignas(64) double damped[lanes], damped_next[lanes];
    alignas(64) double driven[lanes], driven_next[lanes];
    alignas(64) double kinetic[lanes], largest[lanes];

    FLEXPM_INLINE StepSums()
    {
        for (int l = 0; l < lanes; ++l) {
            damped[l] = damped_next[l] = driven[l] = driven_next[l] = 0.0;
            kinetic[l] = largest[l] = 0.0;
        }
    }

    FLEXPM_INLINE void copy_to(StepSums& to) const
    {
        for (int l = 0; l < lanes; ++l) {
            to.damped[l] = damped[l];
            to.damped_next[l] = damped_next[l];
            to.driven[l] = driven[l];
            to.driven_next[l] = driven_next[l];
            to.kinetic[l] = kinetic[l];
            to.largest[l] = largest[l];
        }
    }
};

/// New velocity of a degree of freedom of lane `l`, and the work of damping and of its holder: a force
/// F at step n works over half of the step before and half of the step after,
/// F dt (v(n-1/2) + v(n+1/2)) / 2.
///
/// @param force   generalised force without damping; of a rotation the moment
/// @param length  what makes a force of it for the unbalanced ratio: 1, or an arm [m] of a moment
/// @tparam Held   false: `held` is 0, there is no holder's work
template <bool Measure, bool Held = true>
FLEXPM_INLINE void integrate_one(double force, double held, double inverse_mass, double length,
    double dt, double damping, double& velocity, StepSums& sums, int l)
{
    const double old = velocity, free = Held ? 1.0 - held : 1.0;
    const double against = old > 0.0 ? -1.0 : (old < 0.0 ? 1.0 : 0.0);
    const double damp = free * against * damping * std::fabs(force);
    const double next = old + dt * (free * force + damp) * inverse_mass;
    velocity = next;
    sums.damped[l] -= 0.5 * dt * damp * old;
    sums.damped_next[l] -= 0.5 * dt * damp * next;
    if (Held) {
        const double reaction = (free - 1.0) * force;
        sums.driven[l] += 0.5 * dt * reaction * old;
        sums.driven_next[l] += 0.5 * dt * reaction * next;
    }
    if (Measure) {
        const double mass = inverse_mass > 0.0 ? free / inverse_mass : 0.0;
        sums.kinetic[l] += 0.5 * mass * old * next;
        sums.largest[l] = std::max(sums.largest[l], free * std::fabs(force) / length);
    }
}

}  // namespace flexpm
