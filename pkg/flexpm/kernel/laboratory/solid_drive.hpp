// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The motion that driven ends, plates and node sets give to a specimen in 3D, deviation D30.
/// SI units.
#pragma once

#include <flexpm/kernel/statics/solid_field.hpp>

namespace flexpm {

/// What drives the ends of a specimen: the top, by its plate or by its nodes.
/// @throws std::invalid_argument  if it has no ends
SolidDrive drive_of_top(const SolidState& s);

/// Begin from a linear solution, at a part of the way for which the field is, with what loads at a
/// velocity, by which all grains move as that solution does (deviation D30). Kinetic and elastic
/// energy of this start are the initial ones of the balance.
///
/// @param part      of the field [-], of a crosshead if there is a soft machine
/// @param velocity  of what loads, or of its crosshead [m/s]
/// @param undamped  damping acts only on what grains move beyond that
/// @param dt        time step [s]
/// @throws std::invalid_argument  as begin_from(), or unless the velocity is finite
void start(SolidState& s, const SolidDrive& drive, const SolidField& field, double part,
    double velocity, bool undamped, double dt);

/// Begin from the present state, as of a specimen that bears pressures, with the motion that a
/// linear solution adds. The kinetic energy that this gives is work of the boundary. Arguments and
/// errors as of start().
void take_over(SolidState& s, const SolidDrive& drive, const SolidField& field, double velocity,
    bool undamped, double dt);

/// Begin to move what loads at a velocity, and nothing else: with real masses waves carry it into
/// the grains. Before the first step the balance of energies begins here.
/// @throws std::invalid_argument  unless the velocity is finite
void set_off(SolidState& s, const SolidDrive& drive, double velocity, double dt);

/// Go on at another velocity, and with it the motion that the loading gives, so that the change
/// raises no wave. The kinetic energy that this gives is work of the boundary.
/// @throws std::invalid_argument  unless the velocity is finite
void go_on(SolidState& s, const SolidDrive& drive, double velocity, double dt);

/// Velocities that the loading gives to the nodes, those of rigid grains by their motion, in the
/// layout of Grains::displacement; of held nodes their own [m/s].
Array<double> loading_field(const SolidState& s);

/// Velocity of what loads [m/s, or rad/s].
double velocity_of(const SolidState& s, const SolidDrive& drive);

}  // namespace flexpm
