// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Whether the springs of supports resist what pushes a body, found for the body as a rigid
/// one. SI units.
///
/// A stiffness that a static solution gives for a body that is free to follow is round-off, large
/// or small. Six motions of a rigid body decide it without.
#pragma once

#include <flexpm/kernel/core/vector.hpp>

#include <array>
#include <string>

namespace flexpm {

class RigidSupport {
public:
    /// @param about   point about which rotations are counted, in the middle of the body [m]
    /// @param length  size of the body, by which they count as displacements [m]
    RigidSupport(Vector about, double length) : about_(about), length_(length) { }

    /// Add a spring between a place of the body and a support.
    /// @param along         its direction, a unit vector
    /// @param stiffness     [N/m]
    /// @param displacement  of the support along it [m, or any unit common to all]
    void add(Vector place, Vector along, double stiffness, double displacement);

    /// Add one whose support goes along with the translation of the body: it resists rotations.
    /// @param arm  from where that support turns [m]
    void add_turning(Vector arm, Vector along, double stiffness, double displacement);

    /// @throws std::invalid_argument  if the body can follow what pushes it, so that no spring
    ///         bears; it names that motion and a remedy
    void require_resistance() const;

private:
    static constexpr int motions = 6;
    void add_stretch(Vector translation, Vector rotation, double stiffness, double displacement);

    Vector about_;
    double length_;
    /// Energy of the springs, doubled, as a quadratic form of the six motions and of the push.
    std::array<std::array<double, motions + 1>, motions + 1> form_ {};
};

}  // namespace flexpm
