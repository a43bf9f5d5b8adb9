// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The assembly unpacked into plain rows, for files and pictures. Tension positive, SI
/// units.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

#include <cstdint>
#include <vector>

namespace flexpm {

/// Nodes grain after grain, triangles grain after grain, contacts in their order, points contact
/// after contact. Of what has been erased only the record is left.
struct Snapshot {
    std::vector<double> positions;   ///< [node][x, y] [m]
    std::vector<double> reference;   ///< [node][x, y] [m]
    std::vector<double> velocities;  ///< [node][x, y] [m/s]
    std::vector<double> forces;      ///< [node][x, y] [N]

    std::vector<std::int32_t> triangles;       ///< [triangle][3] nodes
    std::vector<std::int32_t> triangle_grain;  ///< [triangle] grain of the rock
    std::vector<std::int32_t>
        triangle_particle;  ///< [triangle] what moves: grain or inner particle
    std::vector<double>
        triangle_stress;  ///< [triangle][xx, yy, xy] Cauchy; mean of a rigid grain by forces [Pa]

    std::vector<std::int32_t> contact;         ///< [contact] lasting number
    std::vector<std::int32_t> contact_grains;  ///< [contact][2] grains of the rock
    std::vector<double> contact_ends;          ///< [contact][start, end][x, y] [m]
    std::vector<std::int32_t> point_contact;   ///< [point] row of its contact, in `contact`
    std::vector<double> point_share;           ///< [point] of the area of its contact [-]
    std::vector<double> point_opening;         ///< [point] [m]
    std::vector<double> point_slip;            ///< [point] [m]
    std::vector<double> point_damage;          ///< [point] [-]
    std::vector<double> point_traction;        ///< [point][normal, shear] [Pa]
    std::vector<std::int32_t> crack_step;      ///< [point], -1 while intact
    std::vector<std::int32_t> crack_mode;      ///< [point] CrackMode
    std::vector<double> crack_position;        ///< [point][x, y] [m]
    std::vector<double> crack_energy;          ///< [point] damage until it cracked [J]

    std::vector<std::int32_t> erased_contact;  ///< [erased bond] lasting number
    std::vector<std::int32_t>
        erased_grains;  ///< [erased bond][2] grains of the rock, erased or not
    std::vector<double>
        erased_ends;  ///< [erased bond][start, end][x, y] now, nan if a grain is gone [m]
    std::vector<std::int32_t> erased_point_bond;  ///< [erased point] row of its erased bond
    std::vector<std::int32_t> erased_crack_step;  ///< [erased point] of the crack or the erasure
    std::vector<std::int32_t> erased_crack_mode;  ///< [erased point] CrackMode
    std::vector<double> erased_crack_position;    ///< [erased point][x, y] [m]
    std::vector<double> erased_crack_energy;      ///< [erased point] damage until then [J]
};

Snapshot take_snapshot(const Assembly& a);

/// Current end of a contact's edge (0 or 1): the middle between the two grains.
Point contact_end(const Assembly& a, int contact, int end);

}  // namespace flexpm
