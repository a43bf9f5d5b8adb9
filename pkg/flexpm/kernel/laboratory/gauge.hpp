// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Gauges on a specimen: how far two points move apart, how far a plate moves, or a section.
/// SI units.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>
#include <flexpm/kernel/assembly/solid_state.hpp>

#include <vector>

namespace flexpm {

/// Two nodes of grains, by their offsets.
struct GaugePoints {
    int first = -1, second = -1;
};

/// Nodes that are nearest to two places. Of two nodes that lie on each other, as on both sides of a
/// notch, each place takes the one whose grain has its centre nearer to it than to the other place.
/// @throws std::invalid_argument  if the places are one, or the specimen has no grain near one of
///         them
GaugePoints gauge_points(const Grains& grains, Vector first, Vector second);

/// Distance of the points when bonded [m].
double gauge_length(const Grains& grains, const GaugePoints& gauge);

/// How far the points move apart along a unit vector where nodes move so, in the layout of
/// Grains::displacement [m].
/// @throws std::invalid_argument  if one of them is no node of the specimen
double gauge_opening(
    const Grains& grains, const Array<double>& moved, const GaugePoints& gauge, Vector direction);

/// Whether a node is one of an erased grain, which stays where it was.
/// @throws std::invalid_argument  if it is no node of the specimen
bool is_erased(const Grains& grains, int node);

/// A section through a specimen: the nodes in a band, and where they lie.
struct Section {
    std::vector<int> nodes;
    double place =
        0.0;  ///< mean of the bonded nodes along the direction that the band lies across [m]
};

/// Nodes of grains, bonded, that are no further than half a width from a place along a unit vector.
/// @throws std::invalid_argument  if there are none
Section section_at(const Grains& grains, double place, Vector direction, double half_width);

/// Mean way of nodes along a unit vector where they move so, in the same layout [m].
/// @throws std::invalid_argument  if there are none, or one of them is no node of the specimen
double mean_way(const Grains& grains, const Array<double>& moved, const std::vector<int>& nodes,
    Vector direction);

/// Way of a plate along a unit vector [m].
/// @throws std::invalid_argument  if there is no such plate
double plate_way(const BondedState& s, int plate, Vector direction);

/// Way of the crosshead behind a plate along a unit vector [m], that of the plate without a machine,
/// and its velocity there [m/s].
/// @throws std::invalid_argument  as plate_way()
double crosshead_way(const BondedState& s, int plate, Vector direction);
double crosshead_rate(const BondedState& s, int plate, Vector direction);

/// Stored in the spring of the machine behind a plate [J].
/// @throws std::invalid_argument  as plate_way()
double machine_energy(const BondedState& s, int plate);

/// Angle by which a seated plate is turned from square to its normal [rad]: in 2D counter-clockwise,
/// in 3D its size; 0 of others.
/// @throws std::invalid_argument  as plate_way()
double plate_angle(const BondedState& s, int plate);

/// Velocity along a unit vector that the loading gives a plate, where it gives nodes such
/// velocities [m/s].
/// @throws std::invalid_argument  as plate_way()
double plate_rate(const Assembly& a, int plate, Vector direction, const Array<double>& velocity);
double plate_rate(const SolidState& s, int plate, Vector direction, const Array<double>& velocity);

/// Angle over which a disc lies against a jaw, in the mean over its depth: that of the area in
/// contact [rad]; 0 of other plates. contact_angle() of plate_contact.hpp is that of 2D.
/// @throws std::invalid_argument  as plate_way()
double contact_angle(const SolidState& s, int plate);

}  // namespace flexpm
