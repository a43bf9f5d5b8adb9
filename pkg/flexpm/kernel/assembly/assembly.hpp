// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  A bonded assembly of grains: its saved state by topic, and apart from it the plan of a
/// step. SI units, tension positive.
#pragma once

#include <flexpm/kernel/assembly/contacts.hpp>
#include <flexpm/kernel/assembly/energy_ledger.hpp>
#include <flexpm/kernel/assembly/facets.hpp>
#include <flexpm/kernel/assembly/grains.hpp>
#include <flexpm/kernel/assembly/loading_motion.hpp>
#include <flexpm/kernel/assembly/parts.hpp>
#include <flexpm/kernel/assembly/step_plan.hpp>

#include <cstdint>
#include <vector>

namespace flexpm {

struct Assembly {
    // saved: all that continues a run to the same bits
    Grains grains;
    Contacts contacts;
    Facets facets;
    std::vector<Plate> plates;
    std::vector<NodeSet> node_sets;
    std::vector<HeldEdge> held_edges;
    EnergyLedger ledger;
    LoadingMotion loading;
    SteadyMotion steady;
    double thickness = 0.0;  ///< out of plane [m]
    Vector gravity;          ///< acceleration of all masses [m/s^2], by set_gravity()
    std::int64_t step = 0;   ///< steps done

    // derived
    StepPlan plan;

    /// Motion of the grains that damping does not act on.
    const GrainMotion& undamped() const
    {
        return steady.is_followed() ? steady.mean : loading.grains;
    }

    bool has_gravity() const { return gravity.x != 0.0 || gravity.y != 0.0 || gravity.z != 0.0; }

    /// What the plane leaves out: area of a facet and volume of a section, from what is seen of
    /// them. The order of products decides the last digit: a factor that comes first goes in with
    /// the length.
    double area_of(double length) const { return length * thickness; }
    double length_of(double area) const { return area / thickness; }
    double volume_of(double section) const { return section * thickness; }

    /// Calls visit(name, member) for all members that are saved.
    template <class Self, class Visitor> static void visit_members(Self& s, Visitor&& visit)
    {
        visit("grains", s.grains);
        visit("contacts", s.contacts);
        visit("facets", s.facets);
        visit("plates", s.plates);
        visit("node_sets", s.node_sets);
        visit("held_edges", s.held_edges);
        visit("ledger", s.ledger);
        visit("loading", s.loading);
        visit("steady", s.steady);
        visit("thickness", s.thickness);
        visit("gravity_x", s.gravity.x);
        visit("gravity_y", s.gravity.y);
        visit("gravity_z", s.gravity.z);
        visit("step", s.step);
    }
};

}  // namespace flexpm
