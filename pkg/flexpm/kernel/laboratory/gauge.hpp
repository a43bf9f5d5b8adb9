// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Gauges on a specimen: how far two points move apart, how far a plate moves, or a section.
/// SI units.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

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
GaugePoints gauge_points(const Assembly& a, Point first, Point second);

/// Distance of the points when bonded [m].
double gauge_length(const Assembly& a, const GaugePoints& gauge);

/// Way of a plate along a unit vector [m].
/// @throws std::invalid_argument  if there is no such plate
double plate_way(const Assembly& a, int plate, Vector direction);

/// Way of the crosshead behind a plate along a unit vector [m], and its velocity there [m/s].
/// @throws std::invalid_argument  as plate_way()
double crosshead_way(const Assembly& a, int plate, Vector direction);
double crosshead_rate(const Assembly& a, int plate, Vector direction);

/// Velocity along it that the loading gives a plate, where it gives nodes such velocities [m/s].
/// @throws std::invalid_argument  as plate_way()
double plate_rate(const Assembly& a, int plate, Vector direction, const Array<double>& velocity);

/// How far the points move apart along a unit vector where nodes move so, in the layout of
/// Grains::displacement [m].
/// @throws std::invalid_argument  if one of them is no node of the assembly
double gauge_opening(const Array<double>& moved, const GaugePoints& gauge, Vector direction);

/// Whether a node is one of an erased grain, which stays where it was.
/// @throws std::invalid_argument  if it is no node of the assembly
bool is_erased(const Assembly& a, int node);

/// A section through a specimen: the nodes in a band, and where they lie.
struct Section {
    std::vector<int> nodes;
    double place =
        0.0;  ///< mean of the bonded nodes along the direction that the band lies across [m]
};

/// Nodes of grains, bonded, that are no further than half a width from a place along a unit vector.
/// @throws std::invalid_argument  if there are none
Section section_at(const Assembly& a, double place, Vector direction, double half_width);

/// Mean way of nodes along a unit vector where they move so, in the same layout [m].
/// @throws std::invalid_argument  if there are none, or one of them is no node of the assembly
double mean_way(const Array<double>& moved, const std::vector<int>& nodes, Vector direction);

}  // namespace flexpm
