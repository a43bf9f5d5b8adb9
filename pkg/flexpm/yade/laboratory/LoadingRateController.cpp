// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/yade/laboratory/LoadingRateController.hpp>

#include <flexpm/kernel/laboratory/loading_rate.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/yade/solver/GrainSolver.hpp>

namespace yade {

YADE_PLUGIN((LoadingRateController));

LoadingRateController::~LoadingRateController() = default;

void LoadingRateController::action()
{
	const auto solver = GrainSolver::ofScene(*scene);
	if (!solver->measured()) return;
	if (!loading) throw std::runtime_error("LoadingRateController.loading = None, must be the controller that drives the specimen");
	const flexpm::Dissipation     now    = solver->onState([](const auto& state) { return flexpm::dissipation(state); });
	const flexpm::Dissipation     before = seen.size() == 3 ? flexpm::Dissipation { seen[0], seen[1], seen[2] } : now;
	const flexpm::LoadingRateRule rule   = { fastest, slowShare, crossingSteps };

	Real& factor = loading->velocityFactor;
	factor       = flexpm::next_velocity_factor(factor, flexpm::dissipated_share(before, now), solver->measurePeriod, rule);
	seen         = { now.damage, now.friction, now.boundary_work };
}

} // namespace yade
