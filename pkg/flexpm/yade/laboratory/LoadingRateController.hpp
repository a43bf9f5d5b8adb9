// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Adaptive rate of a test's loading, paper Sec. 4.1.
#pragma once

#include <flexpm/yade/bindings/saved_class.hpp>
#include <flexpm/yade/laboratory/LoadingController.hpp>

namespace yade {

class LoadingRateController : public BoundaryController {
public:
	~LoadingRateController() override;
	void action() override;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(LoadingRateController, BoundaryController,
		"Raises and lowers the velocity of a loading: fast while the specimen is elastic, slow while damage and friction take the work. "
		"It looks at each measured step of :yref:`GrainSolver`. Place it last, after :yref:`AxialRecorder`.",
		((shared_ptr<LoadingController>, loading,,, "What drives the specimen; its velocityFactor is set."))
		((Real, fastest, 1.,, "Largest velocity factor [-]."))
		((Real, slowShare, .02,, "The factor is 1 where damage and friction take this share of the boundary's work, or more [-]."))
		((Real, crossingSteps, 1.,, "Steps in which a wave crosses the specimen: the velocity at most doubles in them and at most halves in a quarter of them [-]."))
		((vector<Real>, seen,, Attr::hidden, "Damage and friction energy and the boundary's work at the last look [J]."))
	);
	// clang-format on
};
REGISTER_SAVED(LoadingRateController);

} // namespace yade
