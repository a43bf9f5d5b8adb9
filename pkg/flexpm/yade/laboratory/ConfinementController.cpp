// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/yade/laboratory/ConfinementController.hpp>

#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/laboratory/end_displacement.hpp>
#include <flexpm/yade/solver/GrainSolver.hpp>

namespace yade {

YADE_PLUGIN((ConfinementController));

ConfinementController::~ConfinementController() = default;

void ConfinementController::action()
{
	auto& assembly = GrainSolver::ofScene(*scene)->assembly;
	if (rampBegin < 0) rampBegin = assembly.step;
	const Real now = flexpm::ramped(startPressure, pressure, assembly.step - rampBegin, rampSteps);
	for (int side : sides)
		flexpm::set_pressure(assembly, side, now);
}

} // namespace yade
