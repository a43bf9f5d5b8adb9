// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/yade/laboratory/PlateController.hpp>

#include <flexpm/kernel/forces/plate_contact.hpp>
#include <flexpm/kernel/laboratory/end_displacement.hpp>
#include <flexpm/kernel/laboratory/static_preload.hpp>
#include <flexpm/yade/solver/GrainSolver.hpp>

namespace yade {

YADE_PLUGIN((PlateController));

PlateController::~PlateController() = default;

void PlateController::action()
{
	follow(velocity, seenVelocity, drivenAt);
	auto& assembly = GrainSolver::ofScene(*scene)->assembly;
	for (int plate : plates) {
		if (loaded)
			flexpm::press(assembly, plate, pressure * flexpm::ramp_factor(assembly.step, rampSteps));
		else
			flexpm::set_velocity(assembly, plate, { drivenAt[0], drivenAt[1] });
	}
	if (elasticStart && !started) flexpm::start_elastically(assembly);
	started = true;
}

} // namespace yade
