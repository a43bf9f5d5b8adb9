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
		((Real, velocityFactor, 1.,, "Present velocity over the slowest of the loading; the velocity follows each change of it. :yref:`LoadingRateController` writes it [-] |yupdate|."))
		((Real, seenFactor, 0., Attr::hidden, "The factor at the last step; 0 before the first [-]."))
	);
	// clang-format on

protected:
	/// Factor by which velocities change from the last step to the coming one [-].
	Real factorChange();
};
REGISTER_SERIALIZABLE(LoadingController);

} // namespace yade
