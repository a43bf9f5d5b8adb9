// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Elastic equilibrium of a specimen whose cracks and plates bear pressure and friction
/// alone, deviations D40 and D45: what would pull lets go, what slides bears no shear. SI units,
/// tension positive.
#pragma once

#include <flexpm/kernel/statics/static_solve.hpp>

namespace flexpm {

/// Share of its friction that a point that slides bears, at least.
constexpr double sliding_share = 0.99;

/// As solve_static(), for a state in which points that open, lift off or slide let go, one after
/// the other.
///
/// @param a  a copy for this solution alone: what lets go is loosened in it
/// @throws std::runtime_error  as solve_static()
StaticSolution solve_unilateral(Assembly& a, const std::vector<Prescribed>& prescribed);

/// Contact points that count as cracks for that solution: those with a damage of a half or more.
int count_softened(const Assembly& a);

/// Contacts of joints that are cracked, pressed, and whose faces slide past each other: a joint
/// without strength slides without a point that softens.
int count_sliding_joints(const Assembly& a);

}  // namespace flexpm
