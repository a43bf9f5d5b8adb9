// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  What all plates share that are laid against a specimen. SI units.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

#include <vector>

namespace flexpm {

/// How a plate touches the grains.
struct PlateContact {
    double stiffness = 0.0;  ///< K_n [Pa/m]; 0: that of the first contact law
    double friction = 0.0;   ///< [-]; the shear stiffness has the ratio of the first contact law
    bool bonded = false;     ///< also pulls
    double strip = 0.0;      ///< of a layer between, in series with it [Pa/m]; 0: none
    bool seated = false;     ///< turns about the middle of its face, as on a spherical seat
};

/// Least cosine between the normals of a plate and of a facet that faces it.
constexpr double facing = 0.5;

/// Place of a point along a direction [m].
inline double along(Vector direction, Vector p) { return dot(direction, p); }

/// @throws std::invalid_argument  if it has no length
Point unit(Point normal);

/// A plate with the stiffnesses of its contact, that lies nowhere yet.
/// @throws std::invalid_argument  if a value is out of range
Plate plate_of(const Assembly& a, Point normal, const PlateContact& contact);

/// Where a plate may touch an edge.
enum class TouchAt { middle, ends };

/// Places of these along an edge, 0 to 1.
inline std::vector<double> weights_of(TouchAt points)
{
    return points == TouchAt::middle ? std::vector<double> { 0.5 }
                                     : std::vector<double> { 0.0, 1.0 };
}

/// Points by the grains of some edges, which all deform or all are rigid.
TouchAt points_on(const Assembly& a, const std::vector<int>& facets);

/// A point of a plate on an edge, without gap and area.
/// @param weight  of the edge's second node [-]
PlatePoint point_on_edge(const Plate& p, int facet, double weight);

/// Lay the points of a plate on edges, with their gaps and tributary areas; the state at the
/// reference.
void lay_on_edges(const Assembly& a, Plate& p, const std::vector<int>& facets, TouchAt points);

/// Move the position of a plate along its face to where its load acts: the mean of its points by
/// area.
void centre_position(const Assembly& a, Plate& p);

/// Let a seated plate turn about the middle of its face, where an even pressure has no moment.
void seat(const Assembly& a, Plate& p);

/// Add plates that lie neither on held nodes nor on another plate; their numbers.
std::vector<int> add_plates(Assembly& a, const std::vector<Plate>& plates);

}  // namespace flexpm
