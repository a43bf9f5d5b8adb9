// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/yade/laboratory/LoadingController.hpp>

namespace yade {

YADE_PLUGIN((LoadingController));

LoadingController::~LoadingController() = default;

Real LoadingController::factorChange()
{
	const Real change = seenFactor > 0 ? velocityFactor / seenFactor : 1;
	seenFactor        = velocityFactor;
	return change;
}

} // namespace yade
