// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Load, strains and scales of a test of a box, a cylinder or a disc in 3D between its ends.
/// SI units.
#pragma once

#include <flexpm/kernel/laboratory/axial_measures.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>

namespace flexpm {

using SolidFrame = StateFrame<SolidState>;

/// Component of the axis of a specimen between its ends: z.
constexpr int z_axis = 2;

/// Section and height of the unloaded specimen.
struct SolidExtent {
    double area = 0.0;    ///< of the bottom [m^2]
    double height = 0.0;  ///< [m]
};
SolidExtent extent_of(const SolidState& s);

/// Frame of a specimen between its ends. The axial strain is that between the means of the ends'
/// nodes; of rigid grains that between bands at a quarter and three quarters of the height
/// (deviation D21). The lateral one is the mean of those along x and y, each between the means of
/// the mantle's two sides in the middle third of the height (deviation D80). A layer of one rigid
/// grain has only the other one, a column of them nan.
SolidFrame solid_frame(const SolidState& s, Sense sense);

/// Frame of a disc between its plates: disc_frame() of the plane, its depth along y for the
/// thickness. Widened is it between the grains outermost along x, those within a mean diameter.
/// @throws std::invalid_argument  if a size is not above 0, or there are no plates
SolidFrame solid_disc_frame(const SolidState& s, double diameter, double depth);

/// Lateral strain, positive as Poisson's effect under the sense of the loading [-].
double lateral_strain(const SolidState& s, Sense sense);

/// The same where nodes move so, in the layout of Grains::displacement [-, or 1/s].
double lateral_strain(const SolidState& s, Sense sense, const Array<double>& moved);

/// Forces that hold the ends along z [N].
EndForces end_forces(const SolidState& s);

/// The inputs of the scales, means over all grains, as of the plane.
/// @param thickness  the section's area over its width [m]
ScaleInputs scale_inputs(const SolidState& s, Sense sense, double thickness, double dt);

/// Scales of a test of the specimen as it is; the width is the root of the area.
TestScales solid_scales(const SolidState& s, Sense sense, double dt);
TestScales solid_disc_scales(const SolidState& s, double diameter, double depth, double dt);

/// Steps in which a wave crosses a ball of the grains [-].
double ball_crossing_steps(const SolidState& s, double diameter, double dt);

}  // namespace flexpm
