// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Forces of excavated grains on the wall that they leave, which go step by step.
#pragma once

#include <flexpm/kernel/forces/outer_forces.hpp>
#include <flexpm/yade/abi/yade_lite.hpp>
#include <flexpm/yade/bindings/saved_class.hpp>

namespace yade {

class ReleaseController : public BoundaryController {
public:
	~ReleaseController() override;
	void action() override;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(ReleaseController, BoundaryController,
		"Applies a changing share of the forces of excavated grains to the nodes of the remaining grains. GrainSolver.wallForces returns these forces before the excavation. "
		"Place it before :yref:`GrainSolver`.",
		((vector<int>, nodes,,, "Nodes, ascending, from GrainSolver.wallForces [-]."))
		((vector<Vector3r>, forces,,, "Force on each node, x and y [N]."))
		((Real, part, 0.,, "Share of the forces at the end of the ramp [-]."))
		((Real, startPart, 0.,, "Share of the forces at the beginning of the ramp [-]."))
		((int, rampSteps, 0,, "Steps over which the share changes smoothly from startPart to part [-]."))
		((long, rampBegin, -1,, "First step of the ramp; below 0: the next step [-] |yupdate|."))
		((Real, acting, 0.,, "Share of the forces in the last step [-] |yupdate|."))
	);
	// clang-format on

private:
	flexpm::OuterForces outer; // of this step
};
REGISTER_SAVED(ReleaseController);

} // namespace yade
