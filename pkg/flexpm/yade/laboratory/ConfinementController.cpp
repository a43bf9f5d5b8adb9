// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/yade/laboratory/ConfinementController.hpp>

#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/forces/solid_pressure.hpp>
#include <flexpm/yade/solver/GrainSolver.hpp>

namespace yade {

YADE_PLUGIN((ConfinementController));

ConfinementController::~ConfinementController() = default;

void ConfinementController::press(GrainSolver& solver, Real now) const
{
	for (int side : sides)
		solver.betweenSteps([&](auto& state) { flexpm::set_pressure(state, side, now); });
	PressureController::press(solver, now);
}

} // namespace yade
