// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Static solution of an unloaded 3D specimen between parts, whose plates without a bond
/// press alone. SI units.
/// Deviation D72: the solution is linear, and points of plates open or close until all agree with
/// it. What presses sticks where the plate has friction. Points that do not touch at the beginning
/// have no part in it.
#pragma once

#include <flexpm/kernel/laboratory/solid_parts.hpp>

#include <optional>
#include <vector>

namespace flexpm {

struct SolidPartLoading {
    std::vector<PlatePressure> pressures;  ///< on plates that are free to move
    double way = 0.0;            ///< of what is driven, or of a machine's crosshead [m, or rad]
    std::optional<double> load;  ///< of what is driven, in place of a way [N, or N m]
};

/// A small linear solution, of which the whole has `factor` times what it changes.
struct SolidPartShare {
    SolidPartState small;
    double factor;
};

struct SolidPartSolution {
    std::vector<SolidPartShare> shares;
    double way = 0.0;   ///< of what is driven [m, or rad]
    double load = 0.0;  ///< of what is driven [N, or N m]
    int solutions = 0;  ///< until points were open or closed as the solution has them
};

/// @param s  unloaded; plates under a pressure are free to move
/// @throws std::invalid_argument  as elastic_part_state(), or if nothing resists a load
/// @throws std::runtime_error     if the forces do not come to balance, as of a specimen that is
///         free to move, or points stay neither open nor closed
SolidPartSolution find_elastic_state(
    const SolidState& s, const PartGeometry& parts, const SolidPartLoading& loading, double dt);

}  // namespace flexpm
