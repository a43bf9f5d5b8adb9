// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Plates and curved jaws against the mantle of a disc about the y axis. SI units.
/// Deviation D95: gaps and normals are those of two circles, the inner one touching each facet.
#pragma once

#include <flexpm/kernel/assembly/solid_state.hpp>

namespace flexpm {

/// Lay plates below and on top of a disc, as bottom and top, that touch it and press alone. What
/// they touch at first does not move along x, else the disc would roll (deviation D28), and one
/// place of it not along y. Masses must be scaled again afterwards.
/// @param jaw_radius  of curved jaws [m]; 0: plates are flat
/// @throws std::invalid_argument  if there are plates, no mantle faces them, or a radius is no
///         larger than the disc's
void add_disc_plates(SolidState& s, double jaw_radius = 0.0);

struct SolidJaw {
    Vector towards;         ///< from the disc's axis to the jaw's middle, across the axis
    double ratio = 1.5;     ///< of its radius over the disc's, at least 1; 1: it touches everywhere
    double angle = 1.0;     ///< of the disc that lies before it [rad]
    double friction = 0.0;  ///< coefficient [-]; 0: smooth
    double strip = 0.0;     ///< of a soft layer between, in series [Pa/m]; 0: none
};

/// Lay a jaw. A surface triangle that leaves the angle is touched where what is within has its
/// middle. Masses must be scaled again afterwards.
/// @return  number of the plate
/// @throws std::invalid_argument  for a value out of range, if there is no mantle before it, or if
///                                another plate or held nodes lie there
int add_jaw_plate(SolidState& s, const SolidJaw& jaw);

/// Number of the plate that add_jaw_plate() has laid so; -1 if there is none.
int find_jaw_plate(const SolidState& s, const SolidJaw& jaw);

/// Refuse a plate before a part of the outside that another one has.
/// @throws std::invalid_argument  if two lie before the same place
void require_bare(const SolidState& s, const Plate& plate);

}  // namespace flexpm
