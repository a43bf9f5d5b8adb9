// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Pace of a test's loading.
#include <flexpm/yade/laboratory/PaceEngine.hpp>

#include <flexpm/kernel/laboratory/loading_rate.hpp>
#include <flexpm/yade/laboratory/PlateEngine.hpp>
#include <flexpm/yade/laboratory/PlatenEngine.hpp>
#include <flexpm/yade/solver/GrainSolver.hpp>

namespace yade {

YADE_PLUGIN((PaceEngine));

PaceEngine::~PaceEngine() = default;

Real PaceEngine::ofScene(const Scene& scene)
{
	for (const auto& engine : scene.engines) {
		if (const auto found = YADE_PTR_DYN_CAST<PaceEngine>(engine)) return found->pace;
	}
	return 1;
}

void PaceEngine::action()
{
	const auto solver = GrainSolver::ofScene(*scene);
	if (!solver->measured()) return;
	const flexpm::Dissipation now    = flexpm::dissipation(solver->assembly);
	const flexpm::Dissipation before = seen.size() == 3 ? flexpm::Dissipation { seen[0], seen[1], seen[2] } : now;

	seen = { now.damage, now.friction, now.boundary_work };

	const Real next
	        = flexpm::next_velocity_factor(pace, flexpm::dissipated_share(before, now), solver->measurePeriod, { fastest, slowShare, crossingSteps });
	const Real factor = next / pace;
	for (const auto& engine : scene->engines) {
		if (const auto platens = YADE_PTR_DYN_CAST<PlatenEngine>(engine)) platens->velocity *= factor;
		if (const auto plates = YADE_PTR_DYN_CAST<PlateEngine>(engine)) plates->velocity *= factor;
	}
	pace = next;
}

} // namespace yade
