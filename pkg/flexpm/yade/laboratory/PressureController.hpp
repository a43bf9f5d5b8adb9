// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Pressure on the rigid plates of a test, paper Sec. 4.1.
#pragma once

#include <flexpm/yade/abi/yade_lite.hpp>
#include <flexpm/yade/bindings/saved_class.hpp>

namespace yade {

class GrainSolver;

class PressureController : public BoundaryController {
public:
	~PressureController() override;
	void action() override;

protected:
	/// Press with what the pressure is in the coming step [Pa].
	virtual void press(GrainSolver& solver, Real now) const;

public:
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(PressureController, BoundaryController,
		"Moves rigid plates of :yref:`GrainSolver` under a pressure, each independently along its normal; several on a "
		"side make a membrane. :yref:`PlateController` moves plates at a velocity. Place it before :yref:`GrainSolver`.",
		((vector<int>, plates,,, "Numbers of the plates, as GrainSolver.addSidePlates and addTouchingPlate return them [-]."))
		((Real, pressure, 0.,, "Pressure, of a plate on its width, compressive positive [Pa]."))
		((int, rampSteps, 0,, "Steps over which the pressure goes to its value, gently at both ends [-]."))
		((Real, startPressure, 0.,, "Pressure from which it does [Pa]."))
		((long, rampBegin, -1,, "Step from which they count; below 0: the next one [-] |yupdate|."))
	);
	// clang-format on
};
REGISTER_SAVED(PressureController);

} // namespace yade
