// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The elastic solution of a test whose solid is held and loaded by parts. SI units.
#pragma once

#include <flexpm/kernel/laboratory/part_measures.hpp>
#include <flexpm/kernel/laboratory/solid_frame.hpp>
#include <flexpm/kernel/statics/solid_field.hpp>

namespace flexpm {

/// Drive of a test's elastic solution: a way of 1 m, or an angle of 1 rad.
SolidDrive drive_of(const PartGeometry& parts);

/// Where its elastic solution takes a specimen, whose plates hold what touches them.
struct SolidPartState {
    SolidState state;        ///< with the forces of all parts; what loads goes 1 m or rad in 1 s
    double way = 0.0;        ///< of what is driven, so small that all is linear [m, or rad]; of the
                             ///< crosshead of a soft machine
    double load = 0.0;       ///< of the driven parts [N, or N m]
    double softening = 0.0;  ///< way of the part itself at which the first point of the unloaded
                             ///< specimen softens
};

/// @throws std::invalid_argument  as check_parts()
/// @throws std::runtime_error     if the forces do not come to balance
SolidPartState elastic_part_state(const SolidState& s, const PartGeometry& parts, double dt);

/// Pressure on a plate that is free to move along its normal.
struct PlatePressure {
    int plate;
    double pressure;  ///< [Pa]
};

/// The same under pressures, where what is driven stays. `way` is then the part of the pressures
/// that acts, so small that all is linear [-]. Parts need not be driven.
/// @throws std::invalid_argument  for a plate that no load moves, or if nothing gives way
/// @throws std::runtime_error     if the forces do not come to balance
SolidPartState pressed_part_state(
    const SolidState& s, const PartGeometry& parts, const std::vector<PlatePressure>& pressures);

/// Growth of the load of plates as the grains move at a velocity; of those that hold where node
/// sets are driven [N/s].
double part_load_rate(
    const SolidState& s, const PartGeometry& parts, const Array<double>& velocity);

/// Its scales, from the elastic solution, as part_scales() has them; `width` is the root of the
/// area. The way is that of plates themselves, also in a soft machine. Contacts that pull in that
/// solution bear nothing: with the rock's own stiffnesses a thousandth of the load or less.
/// @param strength  stress that the test may reach, roughly [Pa]; 0: twice that at which the first
///                  point of the unloaded specimen softens
/// @throws std::runtime_error  if the forces do not come to balance
TestScales solid_part_scales(
    const SolidState& s, const PartGeometry& parts, double strength, double dt);

}  // namespace flexpm
