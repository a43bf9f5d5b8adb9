// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  A bonded assembly of grains: its saved state by topic, and apart from it the plan of a
/// step. SI units, tension positive.
#pragma once

#include <flexpm/kernel/assembly/bonded_state.hpp>
#include <flexpm/kernel/assembly/contacts.hpp>
#include <flexpm/kernel/assembly/facets.hpp>
#include <flexpm/kernel/assembly/step_plan.hpp>

#include <vector>

namespace flexpm {

struct Assembly : BondedState {
    // saved: all that continues a run to the same bits
    Contacts contacts;
    Facets facets;
    std::vector<HeldEdge> held_edges;
    double thickness = 0.0;  ///< out of plane [m]

    // derived
    StepPlan plan;

    /// Grain of each facet of the boundary, and the pressures on them [Pa].
    const std::vector<int>& facet_grains() const { return facets.grain; }
    const std::vector<double>& pressures() const { return facets.pressure; }

    /// Whether the spin of a rigid grain is given.
    bool is_spin_held(int grain) const
    {
        return grains.is_rigid(grain) && grains.spin_prescribed[grains.slot[grain]];
    }

    /// What the plane leaves out: area of a facet and volume of a section, from what is seen of
    /// them. The order of products decides the last digit: a factor that comes first goes in with
    /// the length.
    double area_of(double length) const { return length * thickness; }
    double length_of(double area) const { return area / thickness; }
    double volume_of(double section) const { return section * thickness; }

    /// Calls visit(name, member) for all members that are saved.
    template <class Self, class Visitor> static void visit_members(Self& s, Visitor&& visit)
    {
        BondedState::visit_members(s, visit);
        visit("contacts", s.contacts);
        visit("facets", s.facets);
        visit("held_edges", s.held_edges);
        visit("thickness", s.thickness);
    }
};

}  // namespace flexpm
