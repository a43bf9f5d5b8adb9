// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Mean stress of a specimen, and the one that what acts on it from outside would give it in
/// balance. A wave that runs through many grains leaves each node nearly in balance; these two it
/// keeps apart. SI units, tension positive.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

namespace flexpm {

/// How far a specimen is in balance as a whole, at the last step.
struct Balance {
    /// Mean stress of the grains and of what their contacts bear over the distances that they
    /// overlap or open: Cauchy stress of triangles, contact forces times branches of rigid grains,
    /// over the present volume of grains less overlaps [Pa].
    Tensor mean_stress { 0.0, 0.0, 0.0 };
    /// That of pressure, plates, node sets, held nodes and weight: force times place over the same
    /// volume, places counted from the mean of the nodes [Pa].
    Tensor outside_stress { 0.0, 0.0, 0.0 };
    /// Sum of the net forces on all nodes that are free to move [N]: what presses on them less what
    /// bears them.
    Point missing_force { 0.0, 0.0 };
    /// Largest part of its load that the specimen does not bear of a plate under one, above or
    /// below [-].
    double plate_share = 0.0;
};

/// The mean stress and the outside one differ by net forces times places of what is free to move,
/// whatever the shape and strain of the specimen.
Balance balance(const Assembly& a);

}  // namespace flexpm
