// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Rigid motions of a whole structure that no force opposes: a specimen between smooth platens
/// may slide and rotate along them. Equilibrium leaves them undetermined; they stay as they were guessed.
#pragma once

#include <flexpm/kernel/iteration/free_solve.hpp>

#include <array>

namespace flexpm {

class FreeMotions {
public:
    /// @param held  1 for each unknown that is held; both outlive this
    /// @param stiffness  mean of the diagonal of K [N/m], against which a stiffness is zero
    FreeMotions(
        const LinearForces& forces, const std::vector<std::uint8_t>& held, double stiffness);

    int count() const { return static_cast<int>(motions_.size()); }

    /// Take these motions out of a change of the unknowns: of all displacements that balance the
    /// load the one nearest to the guess remains.
    void remove(double* change) const;

private:
    /// A combination of the three translations and the three rotations about the axes.
    using Six = std::array<double, 6>;

    const LinearForces& forces_;
    const std::vector<std::uint8_t>& held_;
    std::vector<Six> motions_;  ///< orthonormal in the free unknowns

    template <class Visit> void for_each_free(Visit visit) const;
    Six sums(const double* values) const;
};

}  // namespace flexpm
