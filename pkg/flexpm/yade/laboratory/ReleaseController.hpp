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
		"Applies the forces of excavated grains to nodes of the remaining grains; GrainSolver.wallForces returns them beforehand. "
		"Their share changes from one value to another. Place it before :yref:`GrainSolver`.",
		((vector<int>, nodes,,, "Nodes, ascending, as GrainSolver.wallForces returns them [-]."))
		((vector<Vector3r>, forces,,, "Force on each, x and y [N]."))
		((Real, part, 0.,, "Part of the forces to which they go [-]."))
		((Real, startPart, 0.,, "Part from which they do [-]."))
		((int, rampSteps, 0,, "Steps over which they do, gently at both ends [-]."))
		((long, rampBegin, -1,, "Step from which they count; below 0: the next one [-] |yupdate|."))
		((Real, acting, 0.,, "Part that has acted in the last step [-] |yupdate|."))
	);
	// clang-format on

private:
	flexpm::OuterForces outer; // of this step
};
REGISTER_SAVED(ReleaseController);

} // namespace yade
