// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Wide motions of solids of bonded grains, which precondition their equilibrium. A smooth load
/// strains grains and opens contacts, as it does springs one behind the other: one coarse grid strains
/// all, another one carries rigid grains, which open contacts. Between the grids and the blocks of
/// nodes stands each grain as a rigid body, which compliant contacts let move more than nodes know.
/// Where contacts are stiff and grains not very many, deformable grains have the first grid alone.
#pragma once

#include <flexpm/kernel/statics/linear_solid.hpp>

namespace flexpm {

/// Wide motions of deformable grains, whose unknowns are the displacements of nodes.
/// @param solid  outlives what is returned, as `held` does
/// @param held   1 for each unknown that is held; more may follow
std::vector<std::unique_ptr<WideMotions>> wide_motions_of(
    const LinearSolid& solid, const std::vector<std::uint8_t>& held);

/// The same of rigid grains.
std::vector<std::unique_ptr<WideMotions>> wide_motions_of(
    const RigidSolid& rigid, const std::vector<std::uint8_t>& held);

}  // namespace flexpm
