// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The two sides of a joint: their grains touch along its faces alone. SI units.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>
#include <flexpm/kernel/geometry/tessellation.hpp>

namespace flexpm {

/// Note that grains on the two sides of a joint never touch by their discs, which would catch on
/// each other as they slide along flat faces. On a side is what has an edge or a corner on the
/// joint, and what lies behind such a grain so closely that its disc could reach one of the other
/// side. Deviation D37.
///
/// @param a  its bonds are those of the shared edges of `t`, in their order
void part_sides_of_joints(Assembly& a, const Tessellation& t);

}  // namespace flexpm
