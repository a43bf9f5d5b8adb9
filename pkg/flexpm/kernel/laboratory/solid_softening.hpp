// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  How far the points of a solid are from their strengths along a motion:
/// softening_ahead.hpp in space, whose shear has two components. SI units, tension positive.
#pragma once

#include <flexpm/kernel/laboratory/softening_ahead.hpp>
#include <flexpm/kernel/statics/solid_loading.hpp>

namespace flexpm {

/// Strain, positive, along `sense` (-1: compression) times a field of strain 1 at which the first
/// point of the unloaded specimen leaves its elastic branch [-]; infinite if none does.
double elastic_strain(const SolidState& s, const SolidField& field, double sense);

/// Factor on the velocity of the loading that brings its points to their strengths slowly enough,
/// as of the plane, along the motion that the loading gives (deviation D58) [-].
double factor_before_softening(const SolidState& s, double dt, const SofteningRule& rule);

}  // namespace flexpm
