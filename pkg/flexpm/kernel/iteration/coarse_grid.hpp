// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Smooth motions of a solid, by a coarse grid of bricks over it: what conjugate gradients
/// are preconditioned by beside blocks on the diagonal, which reach no further than a grain.
#pragma once

#include <flexpm/kernel/fem/tetrahedron.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace flexpm {

/// Motions that are trilinear in each brick of a grid, and the stiffness that they meet.
class CoarseGrid {
public:
    /// Cubes over the nodes, a few grains wide; wider where a solid has very many.
    ///
    /// @param places  of the nodes, whose displacements are the unknowns [m]
    explicit CoarseGrid(const std::vector<Vector>& places);

    /// Add an elastic volume there, a small part of a brick [m^3].
    void add_volume(Vector place, double volume, const PlaneStiffness& c);
    /// Add what holds the solid there, by rows [N/m].
    void add_spring(Vector place, const SpaceGradient& k);

    /// Find the factors of the stiffness. Motions that nothing resists get a little of it.
    void factorize();

    /// Add the smooth motion [m] that forces on free nodes give [N]; none without factors.
    /// @param held  1 for each unknown that is held
    void add_motion(
        const std::vector<std::uint8_t>& held, const double* forces, double* motion) const;

private:
    /// Where a place is in the grid.
    struct Seat {
        int brick;
        std::array<double, 3> from_low;  ///< along x, y, z, in edges of the brick
    };
    struct Factors;

    Vector low_;
    double edge_;
    std::array<int, 3> bricks_ {};            ///< along x, y, z
    std::vector<Seat> seats_;                 ///< of the nodes
    std::vector<double> stiffness_;           ///< of each brick: 24 x 24
    std::shared_ptr<const Factors> factors_;  ///< of the whole grid

    Seat seat(Vector place) const;
    std::array<int, 8> vertices(int brick) const;
    int unknowns() const;
    void add_block(int brick, int a, int b, const SpaceGradient& k);
};

}  // namespace flexpm
