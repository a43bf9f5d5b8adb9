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

/// Points that touch a plate on each facet: grains of either kind, all of one kind.
int points_on_facet(const Assembly& a, const Plate& p);

/// Gaps and tributary areas of the plate's points; the state at the reference.
void lay(const Assembly& a, Plate& p);

/// Move the position of a plate along its face to where its load acts: the mean of its points by
/// area.
void centre_position(const Assembly& a, Plate& p);

/// Let a seated plate turn about the middle of its face, where an even pressure has no moment.
void seat(const Assembly& a, Plate& p);

/// Add plates that lie neither on held nodes nor on another plate; their numbers.
std::vector<int> add_plates(Assembly& a, const std::vector<Plate>& plates);

}  // namespace flexpm
