// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  A solid unpacked into plain rows, for files and pictures: snapshot.hpp in space. Tension
/// positive, SI units.
#pragma once

#include <flexpm/kernel/assembly/solid_state.hpp>

#include <cstdint>
#include <vector>

namespace flexpm {

/// Nodes grain after grain, the centre last; tetrahedra grain after grain; contacts in their order,
/// points contact after contact. Stresses are xx, yy, zz, yz, xz, xy.
struct SolidSnapshot {
    std::vector<double> positions;           ///< [node][3] [m]
    std::vector<double> reference;           ///< [node][3] [m]
    std::vector<double> velocities;          ///< [node][3] [m/s]; of a rigid grain by its motion
    std::vector<double> forces;              ///< [node][3] [N]
    std::vector<std::int32_t> node_offsets;  ///< first node of each grain, and the end

    std::vector<double> centres;       ///< [grain][3] now [m]
    std::vector<double> volumes;       ///< [grain] at the reference [m^3]
    std::vector<double> spins;         ///< [grain][3] of rigid grains, else empty [rad/s]
    std::vector<double> grain_stress;  ///< [grain][6] mean; of a rigid one by the forces on it [Pa]

    std::vector<std::int32_t> tetrahedra;         ///< [tetrahedron][4] nodes, right-handed
    std::vector<std::int32_t> tetrahedron_grain;  ///< [tetrahedron]
    std::vector<double>
        tetrahedron_stress;  ///< [tetrahedron][6] Cauchy; of a rigid grain its mean [Pa]

    std::vector<std::int32_t> surface;        ///< [triangle][3] nodes, seen from outside
    std::vector<std::int32_t> surface_grain;  ///< [triangle]
    std::vector<std::int32_t> surface_side;   ///< [triangle] SolidSide

    std::vector<std::int32_t> contact_grains;  ///< [contact][2]
    std::vector<std::int32_t> corner_offsets;  ///< first corner of each contact, and the end
    std::vector<std::int32_t> corner_nodes;    ///< [corner][2 sides] nodes
    std::vector<double> corners;               ///< [corner][3] of the middle face now [m]
    std::vector<double> normals;               ///< [contact][3] of the middle face
    std::vector<double> areas;                 ///< [contact] when bonded [m^2]

    std::vector<std::int32_t> point_offsets;  ///< first point of each contact, and the end
    std::vector<double> point_area;           ///< [point] [m^2]
    std::vector<double> point_position;       ///< [point][3] now [m]
    std::vector<double> point_opening;        ///< [point] [m]
    std::vector<double> point_slip;           ///< [point][2] along the tangents [m]
    std::vector<double> point_damage;         ///< [point] [-]
    std::vector<double> point_traction;       ///< [point][normal, two shears] [Pa]
    std::vector<std::int64_t> crack_step;     ///< [point], -1 while intact
    std::vector<std::int32_t> crack_mode;     ///< [point] CrackMode
    std::vector<double> crack_position;       ///< [point][3] [m]
    std::vector<double> crack_energy;         ///< [point] damage until it cracked [J]
};

SolidSnapshot take_snapshot(const SolidState& s);

}  // namespace flexpm
