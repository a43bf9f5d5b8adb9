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

/// Translation and rotation of a rigid grain, or force and moment on it about its centre.
struct GridMotion {
    Vector way, turn;
};

/// Motions that are trilinear in each brick of a grid, and the stiffness that they meet: of nodes, or
/// of rigid grains, which turn with the grid, too.
class CoarseGrid {
public:
    enum class Moves { nodes, grains };

    /// Cubes over the nodes, a few grains wide; wider where a solid has very many.
    ///
    /// @param nodes    their positions [m]
    /// @param centres  of the grains [m]
    CoarseGrid(const std::vector<Vector>& nodes, const std::vector<Vector>& centres, Moves moves);

    /// Add an elastic volume there, a small part of a brick [m^3].
    void add_volume(Vector place, double volume, const PlaneStiffness& c);
    /// Add what holds the solid there, by rows [N/m].
    void add_spring(Vector place, const SpaceGradient& k);
    /// Add what holds a rigid grain there, by rows [N/m].
    /// @param arm  from its centre [m]
    void add_spring(int grain, Vector arm, const SpaceGradient& k);
    /// Add a point of a contact of rigid grains, by rows [N/m].
    /// @param branch  from the centre of one grain to that of the other [m]
    void add_contact(Vector place, Vector branch, const SpaceGradient& k);

    /// Find the factors of the stiffness. Motions that nothing resists get a little of it.
    void factorize();

    /// Add the smooth motion [m] that forces on free nodes give [N]; none without factors.
    /// @param held  1 for each unknown that is held
    void add_motion(
        const std::vector<std::uint8_t>& held, const double* forces, double* motion) const;

    /// Smooth motions of rigid grains [m, rad] under loads on them [N, N m]; none without factors.
    std::vector<GridMotion> motions(const std::vector<GridMotion>& loads) const;

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
    std::vector<Seat> seats_;                 ///< of what moves
    std::vector<double> stiffness_;           ///< of each brick: 24 x 24
    std::shared_ptr<const Factors> factors_;  ///< of the whole grid

    Seat seat(Vector place) const;
    std::array<int, 8> vertices(int brick) const;
    int unknowns() const;
    void add_block(int brick, int a, int b, const SpaceGradient& k);
    void add_spring(int brick, const std::array<SpaceGradient, 8>& shares, const SpaceGradient& k);
};

}  // namespace flexpm
