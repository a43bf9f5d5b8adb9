// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Members that a saved state holds: visit_members(part, visit) calls visit(name, member) for those of each part
/// of an assembly, by which a run continues to the same bits.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

#include <type_traits>

namespace flexpm {

/// Parts of an assembly list their members themselves.
template <class Part, class Visitor> void visit_members(Part& part, Visitor&& visit)
{
    using Plain = std::remove_const_t<Part>;
    if constexpr (std::is_same_v<Plain, ElasticMaterial>) {
        visit("young", part.young);
        visit("poisson", part.poisson);
        visit("density", part.density);
        visit("plane", part.plane);
    } else if constexpr (std::is_same_v<Plain, LawParameters>) {
        visit("normal_stiffness", part.normal_stiffness);
        visit("shear_stiffness", part.shear_stiffness);
        visit("tensile_strength", part.tensile_strength);
        visit("cohesion", part.cohesion);
        visit("friction", part.friction);
        visit("elastic_opening", part.elastic_opening);
        visit("critical_opening", part.critical_opening);
        visit("critical_slip", part.critical_slip);
        visit("inverse_softening_length", part.inverse_softening_length);
        visit("slip_compliance", part.slip_compliance);
        visit("dilation_compliance", part.dilation_compliance);
        visit("dilation_limit", part.dilation_limit);
    } else {
        Plain::visit_members(part, visit);
    }
}

}  // namespace flexpm
