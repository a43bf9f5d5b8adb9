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
		"Raises and lowers the velocity of a loading: fast while the specimen is elastic, slow while damage and friction dissipate the work. "
		"It is evaluated at each measured step of :yref:`GrainSolver`. Place it last, after :yref:`AxialRecorder`.",
		((shared_ptr<LoadingController>, loading,,, "Loading engine whose velocityFactor is set."))
		((Real, fastest, 1.,, "Largest velocity factor [-]."))
		((Real, slowShare, .02,, "Share of the boundary's work dissipated by damage and friction from which on the factor is 1 [-]."))
		((Real, crossingSteps, 1.,, "Steps of one wave transit of the specimen. During one transit the velocity at most doubles; during a quarter of it the velocity at most halves [-]."))
		((vector<Real>, seen,, Attr::hidden, "Damage and friction energy and the boundary's work at the last evaluation [J]."))
	);
	// clang-format on
};
REGISTER_SAVED(LoadingRateController);

} // namespace yade
