// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Members that a saved state holds: visit_members(part, visit) calls visit(name, member)
/// for those of each part of an assembly, by which a run continues to the same bits.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

#include <type_traits>

namespace flexpm {

/// Parts of an assembly list their members themselves.
template <class Part, class Visitor> void visit_members(Part& part, Visitor&& visit)
{
    std::remove_const_t<Part>::visit_members(part, visit);
}

}  // namespace flexpm
