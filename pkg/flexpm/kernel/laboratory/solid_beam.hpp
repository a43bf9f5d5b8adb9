// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  A beam, or half a disc, on two rollers and under a head, which bear along lines across
/// its depth, beside plates of solid_parts.hpp. SI units.
/// Deviation D99: a roller has no width but that of its stiffness, so that the span is exact.
#pragma once

#include <flexpm/kernel/assembly/solid_state.hpp>
#include <flexpm/kernel/space/solid.hpp>

namespace flexpm {

/// A line along y on the outside of a specimen.
struct BearingLine {
    double x = 0.0;       ///< [m]
    double z = 0.0;       ///< [m]
    double width = 0.0;   ///< of the face that it stands for: stiffness is that of such a strip [m]
    bool pinned = false;  ///< it does not slide while it presses
};

/// Lay a plate along a line: on the bottom, or from above as the top. It does not turn the
/// specimen about y. Masses must be scaled again afterwards.
/// @return  number of the plate
/// @throws std::invalid_argument  for another side, a width that is not above 0, or if no triangle
///                                of the surface faces the plate there
int add_line_plate(SolidState& s, SolidSide side, const BearingLine& line);

/// Number of the plate that add_line_plate() has laid so; -1 if there is none.
int find_line_plate(const SolidState& s, SolidSide side, const BearingLine& line);

/// Where a notch opens on the bottom.
struct Mouth {
    double middle = 0.0;  ///< x [m]
    double reach = 0.0;   ///< to either side, where its opening is read [m]
};

/// How far two lines of the bottom move apart, that lie `reach` to either side of the middle; means
/// over the depth [m].
double mouth_opening(const SolidState& s, const Mouth& mouth);

/// The same where nodes move so, in the layout of Grains::displacement [m, or m/s].
double mouth_opening(const SolidState& s, const Mouth& mouth, const Array<double>& moved);

}  // namespace flexpm
