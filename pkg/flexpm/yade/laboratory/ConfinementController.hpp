// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Pressure on sides of a specimen of deformable grains, paper Sec. 4.1.
#pragma once

#include <flexpm/yade/abi/yade_lite.hpp>
#include <flexpm/yade/bindings/saved_class.hpp>

namespace yade {

class ConfinementController : public BoundaryController {
public:
	~ConfinementController() override;
	void action() override;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(ConfinementController, BoundaryController,
		"Presses on sides of the specimen; the pressure follows the deforming edges. Place it before :yref:`GrainSolver`.",
		((Real, pressure, 0.,, "Pressure, compressive positive [Pa]."))
		((vector<int>, sides, (vector<int> { 1, 3 }),, "Sides of the outline; of a rectangle 0 bottom, 1 right, 2 top, 3 left [-]."))
		((int, rampSteps, 0,, "Steps over which the pressure goes to its value, gently at both ends [-]."))
		((Real, startPressure, 0.,, "Pressure from which it does [Pa]."))
		((long, rampBegin, -1,, "Step from which they count; below 0: the next one [-] |yupdate|."))
	);
	// clang-format on
};
REGISTER_SAVED(ConfinementController);

} // namespace yade
