// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/yade/laboratory/SolidEndsController.hpp>

#include <flexpm/kernel/solid_tests/solid_ends.hpp>
#include <flexpm/kernel/solids/solid_pressure.hpp>
#include <flexpm/kernel/statics/solid_field.hpp>
#include <flexpm/yade/solver/GrainSolver.hpp>

namespace yade {

YADE_PLUGIN((SolidEndsController));

SolidEndsController::~SolidEndsController() = default;

void SolidEndsController::action()
{
	auto* state = GrainSolver::ofScene(*scene)->solid();
	if (!state) throw std::runtime_error("SolidEndsController: solver = one of the plane, must be a SolidSolver");
	const Real before = drivenAt;
	follow(velocity, seenVelocity, drivenAt);
	if (gripped && drivenAt == before) return;
	if (gripped)
		flexpm::drive_top(*state, drivenAt, scene->dt);
	else if (flexpm::is_pressed(*state))
		flexpm::take_over_ends(*state, flexpm::elastic_field(*state), drivenAt, undampedLoading, scene->dt);
	else
		flexpm::start_ends(*state, flexpm::elastic_field(*state), 0, drivenAt, undampedLoading, scene->dt);
	gripped = true;
}

} // namespace yade
