// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Base of the engines that move ends or plates of a specimen at a velocity that may change, paper Sec. 4.1.
#pragma once

#include <flexpm/yade/abi/yade_lite.hpp>

namespace yade {

class LoadingController : public BoundaryController {
public:
	~LoadingController() override;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(LoadingController, BoundaryController,
		"Base of engines that load a specimen at a velocity. Not to be used directly.",
		((Real, velocityFactor, 1.,, "Present velocity over the velocity that is set, which is the slowest; :yref:`LoadingRateController` writes it [-] |yupdate|."))
		((Real, seenFactor, 0., Attr::hidden, "The factor at the last step; 0 before the first [-]."))
	);
	// clang-format on

protected:
	/// Bring the present velocity to the coming step: what is set times the factor.
	///
	/// A change of the factor alone acts by its ratio, so that the velocity keeps its bits while the factor does.
	template <class Velocity> void follow(const Velocity& set, Velocity& seen, Velocity& present)
	{
		if (seenFactor == 0 || set != seen)
			present = set * velocityFactor;
		else
			present *= velocityFactor / seenFactor;
		seen       = set;
		seenFactor = velocityFactor;
	}
};
REGISTER_SERIALIZABLE(LoadingController);

} // namespace yade
