// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/yade/laboratory/LoadingController.hpp>

#include <flexpm/kernel/laboratory/loading_motion.hpp>
#include <flexpm/kernel/statics/unilateral_solve.hpp>

namespace yade {

YADE_PLUGIN((LoadingController));

LoadingController::~LoadingController() = default;

void LoadingController::preload(Real, int) { refusePreload(); }

void LoadingController::release() { refusePreload(); }

void LoadingController::refusePreload() const { throw std::runtime_error(getClassName() + ": preload is available for driven ends only; leave it out"); }

void LoadingController::renew(flexpm::Assembly& assembly, bool cracksCount)
{
	if (assembly.step < renewedAt + renewPeriod) return;
	renewedAt          = assembly.step;
	const int softened = cracksCount ? flexpm::count_softened(assembly) : 0, sliding = flexpm::count_sliding_joints(assembly);
	if (softened != seenSoftened || sliding != seenSliding) flexpm::renew_loading(assembly, seenFactor < 0 ? -1 : 1);
	seenSoftened = softened;
	seenSliding  = sliding;
}

} // namespace yade
