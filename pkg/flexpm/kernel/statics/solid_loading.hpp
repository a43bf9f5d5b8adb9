// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The motion of a specimen in space from a linear solution of it. SI units.
#pragma once

#include <flexpm/kernel/forces/solid_sides.hpp>

#include <cstddef>
#include <vector>

namespace flexpm {

/// z of an end at the reference, by its nodes, or by the plate that touches it [m].
/// @throws std::invalid_argument  if there is neither
double end_place(const SolidState& s, SolidSide side);

/// Motion of a plate as it follows what it touches.
struct PlateMotion {
    double way = 0.0;  ///< along its normal, where a load moves it [m]
    Vector turn;       ///< on its seat [rad]
};

/// A displacement of all grains.
struct SolidField {
    /// Ways of nodes, grain after grain, the centre last; of rigid grains those of centres [m].
    std::vector<Vector> ways;
    std::vector<Vector> turns;  ///< of rigid grains, small [rad]; else empty
    /// Motions of the plates that a load moves or that turn on a seat, by number; none of others
    /// and beyond the last of them.
    std::vector<PlateMotion> plates = {};
    std::vector<Vector> sets = {};  ///< translations of node sets that float, by number [m]
    double load = 0.0;              ///< of driven plates along the way for which the field is [N]

    Vector of_set(std::size_t set) const { return set < sets.size() ? sets[set] : Vector {}; }
    PlateMotion of_plate(std::size_t plate) const
    {
        return plate < plates.size() ? plates[plate] : PlateMotion {};
    }
};

/// Begin from a linear solution: displacements are `extent` times `field`, velocities `rate` times
/// it, and damping leaves these alone (deviation D30). Points of contacts follow, and the balance
/// of energies begins there.
/// @throws std::invalid_argument  unless there is a vector for each node, or way and turn for each
///         rigid grain
void begin_from(SolidState& s, const SolidField& field, double extent, double rate);

/// Let the balance of energies begin with the present places and velocities, before the first step.
/// Points of contacts follow.
void begin_balance(SolidState& s);

/// Add `rate` times a field to the velocities of what is free to move, at the present places, and
/// let damping leave these alone.
/// @throws std::invalid_argument  as begin_from()
void add_motion(SolidState& s, const SolidField& field, double rate);

}  // namespace flexpm
