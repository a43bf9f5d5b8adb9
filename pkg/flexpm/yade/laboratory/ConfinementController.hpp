// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Pressure on sides of a specimen of deformable grains, paper Sec. 4.1.
#pragma once

#include <flexpm/yade/laboratory/PressureController.hpp>

namespace yade {

class ConfinementController : public PressureController {
public:
	~ConfinementController() override;

protected:
	void press(flexpm::Assembly& assembly, Real now) const override;

public:
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(ConfinementController, PressureController,
		"Presses on sides of the specimen itself; the pressure follows the deforming edges. Place it before :yref:`GrainSolver`.",
		((vector<int>, sides, (vector<int> { 1, 3 }),, "Sides of the outline; of a rectangle 0 bottom, 1 right, 2 top, 3 left [-]."))
	);
	// clang-format on
};
REGISTER_SAVED(ConfinementController);

} // namespace yade
