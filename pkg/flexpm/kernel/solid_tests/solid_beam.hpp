// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  A beam, or half a disc, on two rollers and under a head, which bear along lines across
/// its depth: parts and measures, as plates of part_plates.hpp and part_measures.hpp in the plane,
/// whose y is z here. SI units.
/// Deviation D99: a roller has no width but that of its stiffness, so that the span is exact.
#pragma once

#include <flexpm/kernel/laboratory/loading_scales.hpp>
#include <flexpm/kernel/solid_tests/solid_frame.hpp>
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
/// @throws std::invalid_argument  for another side, a width that is not above 0, or if no triangle
///                                of the surface faces the plate there
void add_line_plate(SolidState& s, SolidSide side, const BearingLine& line);

/// What turns load and way of the head into stress and strain, and where a notch would open.
struct BeamSizes {
    double area = 0.0;    ///< stress = load / area [m^2]
    double length = 0.0;  ///< strain = way / length [m]
    double middle = 0.0;  ///< x of the mouth [m]
    double reach = 0.0;   ///< of the mouth to either side [m]
};

/// Frame of such a test, whose load is positive as the head presses. There is no lateral strain.
/// @throws std::invalid_argument  if area or length are not above 0, or there are no plates below
///                                and on top
SolidFrame solid_beam_frame(const SolidState& s, const BeamSizes& beam);

/// Its scales, from the elastic solution for a way of the head, as part_scales() has them; `width`
/// is the root of the area.
/// @param strength  stress that the test may reach, roughly [Pa]
/// @throws std::runtime_error  if the forces do not come to balance
TestScales solid_beam_scales(
    const SolidState& s, const BeamSizes& beam, double strength, double dt);

/// How far two lines of the bottom move apart, that lie `reach` to either side of the middle; means
/// over the depth [m].
double mouth_opening(const SolidState& s, const BeamSizes& beam);

}  // namespace flexpm
