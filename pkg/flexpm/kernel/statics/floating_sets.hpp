// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Linear forces of a structure in which groups of nodes, which are held otherwise, move as
/// rigid translations. SI units.
#pragma once

#include <flexpm/kernel/iteration/free_solve.hpp>

#include <array>
#include <vector>

namespace flexpm {

/// Nodes that translate together under the forces on them.
struct FloatingNodes {
    std::vector<int> triples;     ///< of the structure's unknowns
    std::array<bool, 3> axes {};  ///< along which the nodes translate together
};

/// A structure whose unknowns are followed by the translations of floating groups of nodes.
class FloatingForces : public LinearForces {
public:
    /// @param structure  with `unknowns` unknowns; both must outlive this
    FloatingForces(const LinearForces& structure, std::size_t unknowns,
        const std::vector<FloatingNodes>& groups);

    void add(const double* u, double* forces) const override;
    DiagonalBlocks diagonal_blocks() const override;
    std::vector<std::unique_ptr<WideMotions>> wide_motions(
        const std::vector<std::uint8_t>& held) const override
    {
        return structure_.wide_motions(held);  // the groups' translations are blocks alone
    }
    /// A group has no part in rotations: one that would move it is not looked for.
    RigidPart rigid_part(int triple) const override
    {
        if (static_cast<std::size_t>(triple) < unknowns_ / 3) return structure_.rigid_part(triple);
        return { 1.0, 0.0, {} };
    }

private:
    const LinearForces& structure_;
    std::size_t unknowns_;
    const std::vector<FloatingNodes>& groups_;
};

/// Solve as solve_free() does, with the translations of the groups as unknowns at the end. Their
/// nodes are held unknowns of the structure, whose solution has the translations in these places.
/// Without groups it is solve_free().
/// @throws std::runtime_error  if the forces do not come to balance
FreeSolution solve_floating(const LinearForces& structure, const std::vector<FloatingNodes>& groups,
    std::vector<std::uint8_t> held, std::vector<double> load, std::vector<double> guess);

}  // namespace flexpm
