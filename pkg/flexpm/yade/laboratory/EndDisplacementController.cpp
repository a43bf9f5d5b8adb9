// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/yade/laboratory/EndDisplacementController.hpp>

#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/laboratory/end_displacement.hpp>
#include <flexpm/kernel/laboratory/static_preload.hpp>
#include <flexpm/yade/solver/GrainSolver.hpp>

namespace yade {

YADE_PLUGIN((EndDisplacementController));

EndDisplacementController::~EndDisplacementController() = default;

void EndDisplacementController::action()
{
	velocity *= factorChange();
	if (gripped && (!holdTop || velocity == drivenAt)) return;
	auto& assembly = GrainSolver::ofScene(*scene)->assembly;
	if (!gripped) flexpm::grip_bottom(assembly);
	if (!holdTop) return;
	flexpm::move_top(assembly, velocity);
	flexpm::update_prescribed_work(assembly, scene->dt);
	if (!gripped && elasticStart) flexpm::start_elastically(assembly);
	gripped  = true;
	drivenAt = velocity;
}

void EndDisplacementController::preload(Real share, int steps)
{
	const auto world    = Omega::instance().getScene();
	auto&      assembly = GrainSolver::ofScene(*world)->assembly;
	flexpm::grip_bottom(assembly);
	flexpm::move_top(assembly, velocity);
	flexpm::preload(assembly, share, steps, world->dt);
	gripped  = true;
	drivenAt = velocity;
}

void EndDisplacementController::release()
{
	const auto world = Omega::instance().getScene();
	flexpm::release_preload(GrainSolver::ofScene(*world)->assembly, velocity, world->dt);
}

} // namespace yade
