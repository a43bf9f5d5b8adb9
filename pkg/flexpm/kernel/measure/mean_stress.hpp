// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Mean stress of a specimen of 2D or 3D, and the one that the forces on it from outside
/// would give it in balance. A wave that runs through many grains leaves each node nearly in
/// balance; these two it keeps apart. SI units, tension positive.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>
#include <flexpm/kernel/assembly/solid_state.hpp>

namespace flexpm {

/// How far a specimen is in balance as a whole, at the last step. In 2D all that has a z is 0.
struct Balance {
    /// Mean stress of the grains and of the forces that their contacts bear over the distances that
    /// they overlap or open: Cauchy stress of elements, contact forces times branches of rigid
    /// grains, over the present volume of grains less overlaps [Pa].
    SpaceTensor mean_stress {};
    /// That of pressure, plates, node sets, held nodes and weight: force times place over the same
    /// volume, places counted from the mean of the nodes [Pa].
    SpaceTensor outside_stress {};
    /// Sum of the net forces on all nodes that are free to move [N]: the load on them less the
    /// forces that bear them.
    Vector missing_force;
    /// Largest part of its load that the specimen does not bear of a plate under one, above or
    /// below [-].
    double plate_share = 0.0;
};

/// The mean stress and the outside one differ by net forces times places of all that is free to
/// move, whatever the shape and strain of the specimen. `State` is Assembly or SolidState.
template <class State> Balance balance(const State& s);

}  // namespace flexpm
