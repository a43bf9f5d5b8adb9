// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/yade/laboratory/EndDisplacementController.hpp>

#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/laboratory/end_displacement.hpp>
#include <flexpm/kernel/laboratory/loading_motion.hpp>
#include <flexpm/kernel/laboratory/preload.hpp>
#include <flexpm/yade/solver/GrainSolver.hpp>

namespace yade {

YADE_PLUGIN((EndDisplacementController));

EndDisplacementController::~EndDisplacementController() = default;

void EndDisplacementController::action()
{
	auto& assembly = GrainSolver::ofScene(*scene)->assembly;
	if (gripped && undampedLoading && ofJoints) renew(assembly, false);
	const Real before = drivenAt, ratio = follow(velocity, seenVelocity, drivenAt);
	if (gripped && (!holdTop || drivenAt == before)) return;
	if (!gripped) flexpm::grip_bottom(assembly);
	if (!holdTop) return;
	flexpm::move_top(assembly, drivenAt);
	flexpm::update_prescribed_work(assembly, scene->dt);
	if (undampedLoading && gripped)
		flexpm::change_loading(assembly, ratio);
	else if ((elasticStart || undampedLoading) && !gripped)
		flexpm::start_elastically(assembly, undampedLoading);
	gripped = true;
}

void EndDisplacementController::preload(Real share, int steps)
{
	const auto world    = Omega::instance().getScene();
	auto&      assembly = GrainSolver::ofScene(*world)->assembly;
	follow(velocity, seenVelocity, drivenAt);
	flexpm::grip_bottom(assembly);
	flexpm::move_top(assembly, drivenAt);
	heldBefore = flexpm::preload(assembly, { share, steps, world->dt });
	gripped    = true;
}

void EndDisplacementController::release()
{
	const auto world = Omega::instance().getScene();
	flexpm::release_preload(GrainSolver::ofScene(*world)->assembly, heldBefore, drivenAt, world->dt, undampedLoading);
}

} // namespace yade
