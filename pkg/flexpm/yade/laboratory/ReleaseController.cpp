// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/yade/laboratory/ReleaseController.hpp>

#include <flexpm/kernel/laboratory/end_displacement.hpp>
#include <flexpm/yade/solver/GrainSolver.hpp>

namespace yade {

YADE_PLUGIN((ReleaseController));

ReleaseController::~ReleaseController() = default;

void ReleaseController::action()
{
	const auto solver   = GrainSolver::ofScene(*scene);
	auto&      assembly = solver->assembly;
	if (rampBegin < 0) rampBegin = assembly.step;
	outer.nodes = nodes;
	outer.forces.clear();
	for (const auto& force : forces)
		outer.forces.push_back({ force[0], force[1] });
	outer.before = acting;
	outer.part = acting = flexpm::ramped(startPart, part, assembly.step - rampBegin, rampSteps);
	if (outer.before != 0 || outer.part != 0) solver->act(outer);
}

} // namespace yade
