// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Equilibrium by conjugate gradients of what is given as an operator: no matrix is stored.
/// Sums have a fixed order, on any threads, so results have the same bits everywhere. SI units.
#pragma once

#include <flexpm/kernel/iteration/diagonal_blocks.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace flexpm {

/// Motions that reach further than blocks on the diagonal do, with the stiffness that they meet.
class WideMotions {
public:
    virtual ~WideMotions() = default;

    /// Add to free unknowns the motion that forces give, which are 0 on held ones.
    virtual void add(const double* forces, double* u) const = 0;
};

/// How three unknowns move when the whole structure moves as a rigid body: by the translation times
/// `way`, by the rotation times `turn` and by what the rotation gives at `arm`.
struct RigidPart {
    double way = 0.0, turn = 0.0;
    Vector arm;  ///< from the origin
};

/// Linear forces of a structure whose unknowns come in threes.
class LinearForces {
public:
    virtual ~LinearForces() = default;

    /// Add K u: the forces that hold it at these displacements.
    virtual void add(const double* u, double* forces) const = 0;

    /// Blocks on the diagonal of K: of each triple, or of groups that stiff springs join.
    virtual DiagonalBlocks diagonal_blocks() const = 0;

    /// Wide motions of it. A load moves it by all of them and by the blocks, as it does springs
    /// one behind the other.
    /// @param held  1 for each unknown that is held; outlives what is returned
    virtual std::vector<std::unique_ptr<WideMotions>> wide_motions(
        const std::vector<std::uint8_t>& /*held*/) const
    {
        return {};
    }

    /// Part of a triple in a rigid motion of the whole; none: these motions are not looked for.
    virtual RigidPart rigid_part(int /*triple*/) const { return {}; }
};

struct FreeSolution {
    std::vector<double> u;
    int iterations = 0;
    double residual = 0.0;  ///< relative to the load [-]
};

/// Solve K u = load for all unknowns but the held ones, which stay 0. Rigid motions of the whole that
/// no force opposes are those of the guess, as far as rigid_part() has them. Those of a part alone are
/// not determined.
///
/// @param held  1 for each unknown that is held
/// @throws std::runtime_error  if the forces do not come to balance
FreeSolution solve_free(const LinearForces& forces, const std::vector<std::uint8_t>& held,
    std::vector<double> load, const std::vector<double>& guess);

}  // namespace flexpm
