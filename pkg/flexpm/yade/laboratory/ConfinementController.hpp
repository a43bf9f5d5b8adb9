// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Pressure on sides of a specimen of deformable grains, paper Sec. 4.1.
#pragma once

#include <flexpm/yade/laboratory/PressureController.hpp>

namespace yade {

class ConfinementController : public PressureController {
public:
	~ConfinementController() override;

protected:
	void press(GrainSolver& solver, Real now) const override;

public:
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(ConfinementController, PressureController,
		"Applies a pressure to sides of the specimen; the pressure follows the deforming edges, or triangles in 3D. Place it before :yref:`GrainSolver`.",
		((vector<int>, sides, (vector<int> { 1, 3 }),, "Sides of the outline; of a rectangle 0 bottom, 1 right, 2 top, 3 left; of a box also 4 front, 5 back; of a cylinder 0 bottom, 1 lateral surface, 2 top [-]."))
	);
	// clang-format on
};
REGISTER_SAVED(ConfinementController);

} // namespace yade
