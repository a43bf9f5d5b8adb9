// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/yade/laboratory/CrackWaitController.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/laboratory/crack_wait.hpp>
#include <flexpm/kernel/laboratory/loading_motion.hpp>
#include <flexpm/kernel/laboratory/softening_ahead.hpp>
#include <flexpm/kernel/laboratory/solid_ends.hpp>
#include <flexpm/kernel/laboratory/steady_motion.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/yade/solver/GrainSolver.hpp>

#include <limits>

namespace yade {

YADE_PLUGIN((CrackWaitController));

CrackWaitController::~CrackWaitController() = default;

void CrackWaitController::action()
{
	const auto solver = GrainSolver::ofScene(*scene);
	if (!solver->measured()) return;
	if (!recorder || !recorder->loading)
		throw std::runtime_error("CrackWaitController.recorder = None or without loading, must be the recorder of the test");
	flexpm::check_positive("CrackWaitController.sweep", sweep, "m3/s");
	const flexpm::Dissipation   sum = solver->onState([](const auto& state) { return flexpm::dissipation(state); });
	const Real                  now = sum.damage + (ofFriction ? sum.friction : 0), steps = solver->measurePeriod, time = steps * scene->dt;
	const Real                  damped = solver->onState([&](const auto& state) { return flexpm::damping_power(state, solver->damping); });
	const Real                  lost   = (seen < 0 ? 0 : now - seen) + time * damped;
	const flexpm::CrackWatch    watch  = { lost, flexpm::swept_work(recorder->stress, sweep, time), recorder->differential, recorder->peak, steps };
	const flexpm::CrackWaitRule rule   = { fastest, slowest, runningShare, shareAfterPeak, crossingSteps };
	Real&                       factor = recorder->loading->velocityFactor;
	const Real                  most   = mostAhead(*solver);
	factor                             = flexpm::factor_ahead(flexpm::factor_for_cracks(factor, watch, rule), most, rule);
	seen                               = now;
	solver->onState([&](auto& state) {
		if (undampedDescent && watch.has_fallen())
			flexpm::follow_steady_motion(state, scene->dt, fastestDescent);
		else
			flexpm::end_steady_motion(state);
	});
}

Real CrackWaitController::mostAhead(GrainSolver& solver) const
{
	if (softeningGrowth == 0) return std::numeric_limits<Real>::infinity();
	const flexpm::SofteningRule rule  = { softeningGrowth, crossingSteps };
	const auto&                 plane = solver.assembly;
	const auto*                 solid = solver.placed();
	return recorder->loading->velocityFactor
	        * (solid ? flexpm::factor_before_softening(*solid, scene->dt, rule)
	                 : flexpm::factor_before_softening(plane, flexpm::loading_field(plane), scene->dt, rule));
}

void CrackWaitController::release()
{
	GrainSolver::ofScene(*Omega::instance().getScene())->onState([](auto& state) { flexpm::end_steady_motion(state); });
}

} // namespace yade
