// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Two rows of squares on a joint without strength, along which they can slide far. SI
/// units.
#pragma once

#include <flexpm/kernel/topology/contact_update.hpp>

#include "driven.hpp"

namespace joint_rows {

constexpr double size = 3e-3;  ///< of a square [m]
constexpr int columns =
    10;  ///< grain i is the i-th of the lower row, grain i + columns the one above it
constexpr double friction = 0.5;

inline flexpm::ContactMaterial smooth_joint()
{
    flexpm::ContactMaterial m;
    m.normal_stiffness = 1e13;
    m.shear_ratio = 0.5;
    m.friction = friction;
    return m;
}

/// Both rows, free to move.
inline flexpm::Assembly two_rows(
    bool rigid = false, int points = 3, const flexpm::ContactMaterial& joint = smooth_joint())
{
    auto options = specimens::options();
    options.rigid = rigid;
    options.points = points;
    options.joints = { joint };
    const auto rows = specimens::grid(columns, 2, size);
    for (const auto& edge : rows.cells.shared_edges)
        options.edge_joint.push_back(edge.cell_b == edge.cell_a + columns ? 0 : -1);
    return specimens::assemble(rows, options);
}

/// Both rows, all of whose motion is given.
inline flexpm::Assembly held_rows(
    bool rigid = false, int points = 3, const flexpm::ContactMaterial& joint = smooth_joint())
{
    flexpm::Assembly a = two_rows(rigid, points, joint);
    driven::hold_all(a);
    std::fill(a.grains.spin_prescribed.begin(), a.grains.spin_prescribed.end(), 1);
    return a;
}

/// Move the upper row, and let its faces follow before each step.
inline void move_row(flexpm::Assembly& a, flexpm::Point way, int steps)
{
    for (int g = columns; g < 2 * columns; ++g)
        driven::set_velocity(a, g, (1.0 / steps) * way);
    for (int i = 0; i < steps; ++i) {
        flexpm::follow_faces(a, 0.7, 1.0);
        driven::run(a, 1);
    }
}

}  // namespace joint_rows
