// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Points, plates and sections of a specimen in space, and how far they move: gauge.hpp
/// there. SI units.
#pragma once

#include <flexpm/kernel/laboratory/gauge.hpp>
#include <flexpm/kernel/assembly/solid_state.hpp>

#include <vector>

namespace flexpm {

/// Nodes that are nearest to two places, as gauge_points() of the plane finds them.
/// @throws std::invalid_argument  if the places are one, or no grain is near one of them
GaugePoints gauge_points(const SolidState& s, Vector first, Vector second);

/// Distance of the points when bonded [m].
double gauge_length(const SolidState& s, const GaugePoints& gauge);

/// How far the points move apart along a unit vector, where nodes move so, in the layout of
/// Grains::displacement [m, or m/s].
/// @throws std::invalid_argument  if one of them is no node of the specimen
double opening_in_space(const Array<double>& moved, const GaugePoints& gauge, Vector direction);

/// Way of a plate along a unit vector [m].
/// @throws std::invalid_argument  if there is no such plate
double plate_way(const SolidState& s, int plate, Vector direction);

/// Way of the crosshead behind it; without a machine that of the plate [m].
double crosshead_way(const SolidState& s, int plate, Vector direction);

/// What these grow by in a unit of time with the motion that the loading gives [m/s].
/// @param velocity  that it gives to the nodes
double plate_rate(const SolidState& s, int plate, Vector direction, const Array<double>& velocity);
double crosshead_rate(const SolidState& s, int plate, Vector direction);

/// Stored in the spring of the machine behind a plate [J].
/// @throws std::invalid_argument  if there is no such plate
double machine_energy(const SolidState& s, int plate);

/// By how much a seated plate is turned from square to its normal [rad]; 0 of others.
/// @throws std::invalid_argument  if there is no such plate
double tilt(const SolidState& s, int plate);

/// Angle over which a disc lies against a jaw, in the mean over its depth: that of the area in
/// contact [rad]; 0 of other plates.
/// @throws std::invalid_argument  if there is no such plate
double contact_angle(const SolidState& s, int plate);

/// A section through a specimen: the nodes in a band, and where they lie.
struct SolidSection {
    std::vector<int> nodes;
    double place = 0.0;  ///< mean of the bonded nodes along the direction [m]
};

/// Nodes of grains, bonded, that are no further than half a width from a place along a unit vector.
/// @throws std::invalid_argument  if there are none
SolidSection section_at(const SolidState& s, double place, Vector direction, double half_width);

/// Mean way of nodes along a unit vector, likewise [m, or m/s].
/// @throws std::invalid_argument  if there are none, or one of them is no node of the specimen
double mean_way_in_space(
    const Array<double>& moved, const std::vector<int>& nodes, Vector direction);

}  // namespace flexpm
