// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The saved sums of an assembly's energy balance: works that only grow, and what was
/// measured last.
#pragma once

#include <flexpm/kernel/core/array.hpp>

namespace flexpm {

/// Arrays hold one value or pair of values for each block of grains. Pairs are the work done so far
/// and the second half of that of the last step, which belongs to the step that follows.
struct EnergyLedger {
    Array<double> damping_work;  ///< [block][done, second half of the last step] [J]
    /// The part of it that goes with the motion that damping leaves alone, positive where damping
    /// drags on that [J].
    Array<double> drag_work;
    Array<double> prescribed_work;  ///< the same of components with a given velocity [J]
    double pressure_work = 0.0;     ///< [J]
    double removed_damage = 0.0;    ///< dissipated by contacts that have been removed [J]
    double removed_friction = 0.0;  ///< [J]
    /// Stored and in motion in grains and bonds when scripts erased them [J]; of the motion, what
    /// the half step after the erasure adds follows with that step.
    double erased = 0.0, erased_next = 0.0;
    double initial = 0.0;  ///< kinetic and elastic energy when the balance was last reset [J]

    // at the last measured step
    Array<double> kinetic;        ///< [block] 1/2 m v(n-1/2) v(n+1/2) [J]
    Array<double> largest_force;  ///< [block] largest force component on a free node [N]

    /// Calls visit(name, member) for all members.
    template <class Self, class Visitor> static void visit_members(Self& s, Visitor&& visit)
    {
        visit("damping_work", s.damping_work);
        visit("drag_work", s.drag_work);
        visit("prescribed_work", s.prescribed_work);
        visit("pressure_work", s.pressure_work);
        visit("removed_damage", s.removed_damage);
        visit("removed_friction", s.removed_friction);
        visit("erased", s.erased);
        visit("erased_next", s.erased_next);
        visit("initial", s.initial);
        visit("kinetic", s.kinetic);
        visit("largest_force", s.largest_force);
    }
};

}  // namespace flexpm
