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
		((vector<int>, plates,,, "Indices of the plates, from GrainSolver.addSidePlates or addTouchingPlate [-]."))
		((Real, pressure, 0.,, "Pressure on the width of each plate, compression positive [Pa]."))
		((int, rampSteps, 0,, "Steps over which the pressure changes smoothly from startPressure to its value [-]."))
		((Real, startPressure, 0.,, "Pressure at the beginning of the ramp [Pa]."))
		((long, rampBegin, -1,, "First step of the ramp; below 0: the next step [-] |yupdate|."))
	);
	// clang-format on
};
REGISTER_SAVED(PressureController);

} // namespace yade
