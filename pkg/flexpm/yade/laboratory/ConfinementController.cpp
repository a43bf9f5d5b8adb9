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
	for (int side : sides)
		flexpm::set_pressure(assembly, side, pressure * flexpm::ramp_factor(assembly.step, rampSteps));
}

} // namespace yade
