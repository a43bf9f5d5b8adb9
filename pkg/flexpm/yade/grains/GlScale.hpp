// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The scale that stands beside the specimen in YADE's 3D window.
#pragma once

#include <flexpm/kernel/view/colours.hpp>
#include <flexpm/kernel/view/grain_values.hpp>
#include <flexpm/yade/abi/yade_lite.hpp>

namespace yade {

/// Draws in the plane of the grains, to the right of them; lighting must be off.
class GlScale {
public:
	GlScale(const flexpm::Extent& specimen, const Vector3r& textColor);

	/// The colours from the low end of a range to the high one with their numbers, or those of kinds.
	void draw(flexpm::GrainValue what, flexpm::ValueRange range) const;

private:
	void box(Real from, Real to, flexpm::Colour colour) const;
	void text(Real share, const string& line) const;
	void colours(flexpm::GrainValue what, flexpm::ValueRange range) const;
	void kinds(flexpm::ValueRange range) const;

	Real     left, bottom, width, height; ///< of the scale [m]
	Vector3r textColor;
};

} // namespace yade
