// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/yade/laboratory/PressureController.hpp>

#include <flexpm/kernel/forces/plate_contact.hpp>
#include <flexpm/kernel/laboratory/end_displacement.hpp>
#include <flexpm/yade/solver/GrainSolver.hpp>

namespace yade {

YADE_PLUGIN((PressureController));

PressureController::~PressureController() = default;

void PressureController::action()
{
	auto& assembly = GrainSolver::ofScene(*scene)->assembly;
	if (rampBegin < 0) rampBegin = assembly.step;
	press(assembly, flexpm::ramped(startPressure, pressure, assembly.step - rampBegin, rampSteps));
}

void PressureController::press(flexpm::Assembly& assembly, Real now) const
{
	for (int plate : plates)
		flexpm::press(assembly, plate, now);
}

} // namespace yade
