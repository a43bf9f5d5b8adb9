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
	for (int plate : plates)
		flexpm::press(assembly, plate, pressure * flexpm::ramp_factor(assembly.step, rampSteps));
}

} // namespace yade
