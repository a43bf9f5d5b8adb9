// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/yade/laboratory/SolidLoadingController.hpp>

#include <flexpm/kernel/core/memory.hpp>
#include <flexpm/kernel/laboratory/preload.hpp>
#include <flexpm/kernel/laboratory/solid_drive.hpp>
#include <flexpm/yade/solver/GrainSolver.hpp>

namespace yade {

YADE_PLUGIN((SolidLoadingController));

SolidLoadingController::~SolidLoadingController() = default;

flexpm::SolidState& SolidLoadingController::stateOf(GrainSolver& solver)
{
	auto* state = solver.placed();
	if (!state) throw std::runtime_error("SolidLoadingController: specimen = 2D, must be 3D; use PlateController");
	return *state;
}

flexpm::SolidDrive SolidLoadingController::driveOfParts() const
{
	return { plates, { direction[0], direction[1], direction[2] }, 1, nodeSets, backSets, turns };
}

flexpm::SolidDrive SolidLoadingController::driveOf(const flexpm::SolidState& state) const
{
	const auto parts = driveOfParts();
	return parts.moves_top() ? flexpm::drive_of_top(state) : parts;
}

flexpm::SolidField SolidLoadingController::fieldOf(const flexpm::SolidState& state, int threads) const
{
	const auto parts = driveOfParts();
	flexpm::give_back_memory(); // what the masses have needed
	const auto field = parts.moves_top() ? flexpm::elastic_field(state, threads) : flexpm::elastic_field(state, parts, threads);
	flexpm::give_back_memory(); // the solution has needed as much again as the state
	return field;
}

void SolidLoadingController::action()
{
	const auto solver = GrainSolver::ofScene(*scene);
	const Real before = drivenAt;
	follow(velocity, seenVelocity, drivenAt);
	if (preloaded || (gripped && drivenAt == before)) return;
	auto&      state = stateOf(*solver);
	const auto drive = driveOf(state);
	if (gripped) return flexpm::go_on(state, drive, drivenAt, scene->dt);
	if (!solver->scaled) {
		flexpm::set_off(state, drive, drivenAt, scene->dt);
		gripped = true;
		return;
	}
	const auto field = fieldOf(state, solver->threads());
	if (state.step > 0)
		flexpm::take_over(state, drive, field, drivenAt, undampedLoading, scene->dt);
	else
		flexpm::start(state, drive, field, 0, drivenAt, undampedLoading, scene->dt);
	gripped = true;
}

void SolidLoadingController::preload(Real share, int steps)
{
	if (!driveOfParts().moves_top()) refusePreload();
	const auto world  = Omega::instance().getScene();
	const auto solver = GrainSolver::ofScene(*world);
	auto&      state  = stateOf(*solver);
	follow(velocity, seenVelocity, drivenAt);
	heldBefore = flexpm::preload(state, driveOf(state), fieldOf(state, solver->threads()), drivenAt < 0 ? -1 : 1, { share, steps, world->dt });
	gripped = preloaded = true;
}

void SolidLoadingController::release()
{
	const auto world = Omega::instance().getScene();
	auto&      state = stateOf(*GrainSolver::ofScene(*world));
	flexpm::release_preload(state, driveOf(state), heldBefore, drivenAt, world->dt, undampedLoading);
	preloaded = false;
}

} // namespace yade
