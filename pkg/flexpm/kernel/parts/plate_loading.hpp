// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  How plates are loaded, paper Sec. 4.1: at a velocity, by a pressure, through the spring of
/// a machine; and the motion of a plate under a load. SI units.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>
#include <flexpm/kernel/assembly/solid_state.hpp>

#include <vector>

namespace flexpm {

/// @throws std::invalid_argument  unless there is a plate of that number
void require_plate(const BondedState& state, int plate);

/// Number of the first plate of a side; -1 if there is none.
int find_plate(const BondedState& state, int side);
inline bool has_plates(const BondedState& state, int side) { return find_plate(state, side) >= 0; }

/// Force of the plates of a side on the specimen [N].
Vector plate_force(const BondedState& state, int side);

/// Prescribe a plate's velocity, or that of its crosshead [m/s].
void set_velocity(BondedState& state, int plate, Vector velocity);

/// Let a load move a plate of a solid along its normal. Masses must be scaled again afterwards.
/// @throws std::invalid_argument  if there is no such plate, or it is one of a line or a jaw
void free_plate(SolidState& s, int plate);

/// Let a plate move along its normal under a pressure [Pa] on its width instead of a given
/// velocity; in 3D the plate must be free already. It does not act while all of its grains are
/// loose, which counts as a load that nothing balances.
/// @throws std::invalid_argument  if there is no such plate, its mass is not scaled, or for a
///         pressure below 0
void press(Assembly& a, int plate, double pressure);
void press(SolidState& s, int plate, double pressure);

/// Lay the spring of a soft machine behind a plate [N/m]. It has the plate's present force.
///
/// The spring and the plate have no mass: the plate is where the spring and its contacts balance,
/// at each step. It gives way along its normal alone. A plate under a load has no use of it.
/// Deviation D95.
/// @throws std::invalid_argument  if there is no such plate, the stiffness is not above 0, the
///         plate has another spring, or it is a jaw of a solid with friction
void set_machine(BondedState& state, int plate, double stiffness);

/// Motion of a loaded plate over a step after which its force is known: its new velocity, by which
/// it answers to its load and to the specimen along its normal, and its works. Deviation D57: with
/// loose grains alone before it the load would drive it through the specimen and does not act.
///
/// @param grain_of  grain of each facet of the boundary
void integrate_loaded(BondedState& state, std::size_t plate, const std::vector<int>& grain_of,
    double dt, double damping);

/// Let no load move a plate any more; the half step that it was promised is not taken.
void let_go(Plate& plate);

}  // namespace flexpm
