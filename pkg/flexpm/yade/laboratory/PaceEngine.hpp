// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Pace of a test's loading, paper Sec. 4.1.
#pragma once

#include <flexpm/yade/abi/yade_lite.hpp>

namespace yade {

class PaceEngine : public GlobalEngine {
public:
	~PaceEngine() override;
	void action() override;

	/// The present pace of the scene's loading [-], 1 without such an engine.
	static Real ofScene(const Scene& scene);

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(PaceEngine, GlobalEngine,
		"Raises and lowers the velocities at which :yref:`PlatenEngine` and :yref:`PlateEngine` drive a specimen: fast while it is elastic, "
		"slow while damage and friction take the work. It looks at each measured step of :yref:`GrainSolver`. "
		"Place it last, after :yref:`AxialRecorder`.",
		((Real, fastest, 1.,, "Largest pace [-]."))
		((Real, slowShare, .02,, "The pace is 1 where damage and friction take this share of the boundary's work, or more [-]."))
		((Real, crossingSteps, 1.,, "Steps in which a wave crosses the specimen: the pace at most doubles in them and at most halves in a quarter of them [-]."))
		((Real, pace, 1.,, "Present velocity of the loading over its slowest [-]."))
		((vector<Real>, seen,, Attr::hidden, "Damage and friction energy and the boundary's work at the last look [J]."))
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(PaceEngine);

} // namespace yade
