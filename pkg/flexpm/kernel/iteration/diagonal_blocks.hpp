// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Blocks on the diagonal of a stiffness, and their inverses: what conjugate gradients are
/// preconditioned by.
#pragma once

#include <flexpm/kernel/fem/tetrahedron.hpp>

#include <cstdint>
#include <vector>

namespace flexpm {

/// Blocks of a stiffness whose unknowns come in threes, each of the triples of one group.
class DiagonalBlocks {
public:
    /// @param group_of  number of the group of each triple, from 0 on without gaps
    explicit DiagonalBlocks(const std::vector<int>& group_of);

    /// Add to what two triples, the same or two of one group, have in common; others have no block.
    void add(int row, int column, double factor, const SpaceGradient& k);

    /// Add a triple, which is a group of its own, with its block.
    void append(const SpaceGradient& k);

    /// Mean of the stiffness of an unknown against all others at rest.
    double mean_diagonal() const;

    /// Put inverses in the places of the blocks. A held unknown stays 0; a block that resists no
    /// motion in some way, as of a grain that one point holds, gets a little stiffness there.
    ///
    /// @param held  1 for each unknown that is held
    void invert(const std::vector<std::uint8_t>& held);

    /// Products with all blocks.
    void multiply(const double* right, double* to) const;

    const std::vector<double>& values() const { return values_; }

private:
    std::vector<int> first_ { 0 };          ///< of groups in members_, and the end
    std::vector<int> members_;              ///< triples, group after group
    std::vector<int> group_, place_;        ///< of triples: the group, and the place in it
    std::vector<std::size_t> start_ { 0 };  ///< of groups in values_, and the end
    std::vector<double> values_;            ///< by columns, which are rows, too

    int triples(int group) const { return first_[group + 1] - first_[group]; }
};

}  // namespace flexpm
