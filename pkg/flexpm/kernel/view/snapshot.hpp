// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  A specimen of 2D or 3D unpacked into plain rows, for files and pictures. Tension positive,
/// SI units.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>
#include <flexpm/kernel/assembly/solid_state.hpp>

#include <cstdint>
#include <vector>

namespace flexpm {

/// When, how and where points have lost their bond, and what their damage had taken by then.
struct CrackRows {
    std::vector<std::int64_t> crack_step;  ///< [point], -1 while intact
    std::vector<std::int32_t> crack_mode;  ///< [point] CrackMode
    std::vector<double> crack_position;    ///< [point][axis] [m]
    std::vector<double> crack_energy;      ///< [point] damage until it cracked [J]
};

/// Rows of both dimensions: nodes grain after grain, elements (triangles or tetrahedra) grain after
/// grain, contacts in their order, points contact after contact. A tensor is xx, yy, xy in 2D, and
/// xx, yy, zz, yz, xz, xy in 3D.
struct SnapshotRows : CrackRows {
    std::vector<double> positions;   ///< [node][axis] [m]
    std::vector<double> reference;   ///< [node][axis] [m]
    std::vector<double> velocities;  ///< [node][axis]; of a rigid grain by its motion [m/s]
    std::vector<double> forces;      ///< [node][axis] [N]

    std::vector<std::int32_t> elements;       ///< [element][3 or 4 nodes], right-handed
    std::vector<std::int32_t> element_grain;  ///< [element] grain of the rock
    std::vector<double>
        element_stress;  ///< [element][tensor] Cauchy; mean of a rigid grain by forces [Pa]

    std::vector<std::int32_t> contact_grains;  ///< [contact][2] grains of the rock
    std::vector<double> point_opening;         ///< [point] [m]
    std::vector<double> point_slip;            ///< [point][tangent] [m]
    std::vector<double> point_damage;          ///< [point] [-]
    std::vector<double> point_traction;        ///< [point][normal, tangents] [Pa]
};

/// Rows of 2D. Of what has been erased only the record is left.
struct Snapshot : SnapshotRows {
    std::vector<std::int32_t> element_particle;  ///< [element] what moves: grain or inner particle

    std::vector<std::int32_t> contact;        ///< [contact] lasting number
    std::vector<double> contact_ends;         ///< [contact][start, end][x, y] [m]
    std::vector<std::int32_t> point_contact;  ///< [point] row of its contact, in `contact`
    std::vector<double> point_share;          ///< [point] of the area of its contact [-]

    std::vector<std::int32_t> erased_contact;  ///< [erased bond] lasting number
    std::vector<std::int32_t>
        erased_grains;  ///< [erased bond][2] grains of the rock, erased or not
    std::vector<double>
        erased_ends;  ///< [erased bond][start, end][x, y] now, nan if a grain is gone [m]
    std::vector<std::int32_t> erased_point_bond;  ///< [erased point] row of its erased bond
    CrackRows erased;                             ///< [erased point] of the crack or the erasure
};

/// Rows of 3D. The last node of a grain is its centre.
struct SolidSnapshot : SnapshotRows {
    std::vector<std::int32_t> node_offsets;  ///< first node of each grain, and the end

    std::vector<double> centres;       ///< [grain][3] now [m]
    std::vector<double> volumes;       ///< [grain] at the reference [m^3]
    std::vector<double> spins;         ///< [grain][3] of rigid grains, else empty [rad/s]
    std::vector<double> grain_stress;  ///< [grain][6] mean; of a rigid one by the forces on it [Pa]

    std::vector<std::int32_t> surface;        ///< [triangle][3] nodes, seen from outside
    std::vector<std::int32_t> surface_grain;  ///< [triangle]
    std::vector<std::int32_t> surface_side;   ///< [triangle] SolidSide

    std::vector<std::int32_t> corner_offsets;  ///< first corner of each contact, and the end
    std::vector<std::int32_t> corner_nodes;    ///< [corner][2 sides] nodes
    std::vector<double> corners;               ///< [corner][3] of the middle face now [m]
    std::vector<double> normals;               ///< [contact][3] of the middle face
    std::vector<double> areas;                 ///< [contact] when bonded [m^2]

    std::vector<std::int32_t> point_offsets;  ///< first point of each contact, and the end
    std::vector<double> point_area;           ///< [point] [m^2]
    std::vector<double> point_position;       ///< [point][3] now [m]
};

Snapshot take_snapshot(const Assembly& a);
SolidSnapshot take_snapshot(const SolidState& s);

/// Current end (0 or 1) of the part of the edges on which a contact acts, in the middle between both
/// grains, where displacements are drawn `factor` times larger.
Point contact_end(const Assembly& a, int contact, int end, double factor = 1.0);

}  // namespace flexpm
