// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/yade/laboratory/SolidLoadingController.hpp>

#include <flexpm/kernel/laboratory/solid_drive.hpp>
#include <flexpm/yade/solver/GrainSolver.hpp>

namespace yade {

YADE_PLUGIN((SolidLoadingController));

SolidLoadingController::~SolidLoadingController() = default;

void SolidLoadingController::action()
{
	const auto solver = GrainSolver::ofScene(*scene);
	auto*      state  = solver->solid();
	if (!state) throw std::runtime_error("SolidLoadingController: specimen = 2D, must be 3D; take PlateController");
	const Real before = drivenAt;
	follow(velocity, seenVelocity, drivenAt);
	if (gripped && drivenAt == before) return;
	const flexpm::SolidDrive parts { plates, { direction[0], direction[1], direction[2] }, 1, nodeSets, backSets, turns };
	const auto               drive = parts.moves_top() ? flexpm::drive_of_top(*state) : parts;
	if (gripped) return flexpm::go_on(*state, drive, drivenAt, scene->dt);
	if (!solver->scaled) {
		flexpm::set_off(*state, drive, drivenAt, scene->dt);
		gripped = true;
		return;
	}
	const int  threads = solver->threads();
	const auto field   = parts.moves_top() ? flexpm::elastic_field(*state, threads) : flexpm::elastic_field(*state, drive, threads);
	if (state->step > 0)
		flexpm::take_over(*state, drive, field, drivenAt, undampedLoading, scene->dt);
	else
		flexpm::start(*state, drive, field, 0, drivenAt, undampedLoading, scene->dt);
	gripped = true;
}

} // namespace yade
