// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Central differences with local damping for one degree of freedom, paper Eqs. 1-3, and the
/// works of its forces.
#pragma once

#include <flexpm/kernel/core/array.hpp>
#include <flexpm/kernel/core/compiler.hpp>

#include <algorithm>
#include <cmath>

namespace flexpm {

/// Sums over the degrees of freedom of a block, [lane] [J]; `next` belongs to the half step after.
/// Cleared and copied by loops over lanes: of a whole struct the compiler makes slow string
/// instructions.
struct StepSums {
    alignas(64) double damped[lanes], damped_next[lanes];
    alignas(64) double dragged[lanes];  ///< in either half step: what of it goes with the loading
    alignas(64) double prescribed[lanes], prescribed_next[lanes];
    alignas(64) double kinetic[lanes], largest[lanes];

    FLEXPM_INLINE StepSums()
    {
        for (int l = 0; l < lanes; ++l) {
            damped[l] = damped_next[l] = prescribed[l] = prescribed_next[l] = 0.0;
            dragged[l] = kinetic[l] = largest[l] = 0.0;
        }
    }

    FLEXPM_INLINE void copy_to(StepSums& to) const
    {
        for (int l = 0; l < lanes; ++l) {
            to.damped[l] = damped[l];
            to.damped_next[l] = damped_next[l];
            to.dragged[l] = dragged[l];
            to.prescribed[l] = prescribed[l];
            to.prescribed_next[l] = prescribed_next[l];
            to.kinetic[l] = kinetic[l];
            to.largest[l] = largest[l];
        }
    }
};

/// What moves a degree of freedom.
struct Freedom {
    double force;         ///< generalised force without damping; of a rotation the moment
    double inverse_mass;  ///< generalised; of a rotation that of the moment of inertia
    double prescribed;    ///< 1: the velocity is given; 0: it is integrated
    double undamped;      ///< part of the velocity that is not damped
    double length =
        1.0;  ///< makes a force of it for the unbalanced ratio: 1, or the arm of a moment [m]
};

/// New velocity of a degree of freedom in a lane, and the works of damping and of what prescribes
/// the velocity: a force F at step n works over half of the step before and half of the step after,
/// F dt (v(n-1/2) + v(n+1/2)) / 2.
///
/// @tparam Prescribed  false: the velocity is not prescribed, which need not be looked at
template <bool Measure, bool Prescribed = true>
FLEXPM_INLINE void integrate_one(
    const Freedom& f, double dt, double damping, double& velocity, StepSums& sums, int lane)
{
    const double old = velocity, free = Prescribed ? 1.0 - f.prescribed : 1.0;
    const double against = old > f.undamped ? -1.0 : (old < f.undamped ? 1.0 : 0.0);
    const double damp = free * against * damping * std::fabs(f.force);
    const double next = old + dt * (free * f.force + damp) * f.inverse_mass;
    velocity = next;
    sums.damped[lane] -= 0.5 * dt * damp * old;
    sums.damped_next[lane] -= 0.5 * dt * damp * next;
    sums.dragged[lane] -= 0.5 * dt * damp * f.undamped;
    if (Prescribed) {
        const double reaction = (free - 1.0) * f.force;
        sums.prescribed[lane] += 0.5 * dt * reaction * old;
        sums.prescribed_next[lane] += 0.5 * dt * reaction * next;
    }
    if (Measure) {
        const double mass = f.inverse_mass > 0.0 ? free / f.inverse_mass : 0.0;
        sums.kinetic[lane] += 0.5 * mass * old * next;
        sums.largest[lane] = std::max(sums.largest[lane], free * std::fabs(f.force) / f.length);
    }
}

}  // namespace flexpm
