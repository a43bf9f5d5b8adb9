// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The part of a specimen's saved state that does not depend on the dimension: grains, the
/// parts that hold and load them, the motion of the loading, gravity, and the energy balance. The
/// contacts and the boundary are in Assembly (2D) and SolidState (3D), which derive from it. SI
/// units, tension positive.
#pragma once

#include <flexpm/kernel/assembly/energy_ledger.hpp>
#include <flexpm/kernel/assembly/grains.hpp>
#include <flexpm/kernel/assembly/loading_motion.hpp>
#include <flexpm/kernel/assembly/parts.hpp>

#include <cstdint>
#include <vector>

namespace flexpm {

struct BondedState {
    Grains grains;
    std::vector<Plate> plates;
    std::vector<NodeSet> node_sets;
    EnergyLedger ledger;
    LoadingMotion loading;
    SteadyMotion steady;
    std::int64_t step = 0;  ///< steps done
    Vector gravity;         ///< acceleration of all masses [m/s^2], by set_gravity()

    bool has_gravity() const { return gravity.x != 0.0 || gravity.y != 0.0 || gravity.z != 0.0; }

    /// Motion of the grains that damping does not act on.
    const GrainMotion& undamped() const
    {
        return steady.is_followed() ? steady.mean : loading.grains;
    }

    /// Calls visit(name, member) for all members.
    template <class Self, class Visitor> static void visit_members(Self& s, Visitor&& visit)
    {
        visit("grains", s.grains);
        visit("plates", s.plates);
        visit("node_sets", s.node_sets);
        visit("ledger", s.ledger);
        visit("loading", s.loading);
        visit("steady", s.steady);
        visit("step", s.step);
        visit("gravity_x", s.gravity.x);
        visit("gravity_y", s.gravity.y);
        visit("gravity_z", s.gravity.z);
    }
};

}  // namespace flexpm
