// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/yade/laboratory/PressureController.hpp>

#include <flexpm/kernel/laboratory/end_displacement.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/parts/solid_plates.hpp>
#include <flexpm/yade/solver/GrainSolver.hpp>

namespace yade {

YADE_PLUGIN((PressureController));

PressureController::~PressureController() = default;

void PressureController::action()
{
	const auto solver = GrainSolver::ofScene(*scene);
	const long step   = solver->stepsDone();
	if (rampBegin < 0) rampBegin = step;
	press(*solver, flexpm::ramped(startPressure, pressure, step - rampBegin, rampSteps));
}

void PressureController::press(GrainSolver& solver, Real now) const
{
	for (int plate : plates)
		solver.betweenSteps([&](auto& state) { flexpm::press(state, plate, now); });
}

} // namespace yade
