// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/yade/laboratory/PlateController.hpp>

#include <flexpm/kernel/laboratory/loading_motion.hpp>
#include <flexpm/kernel/parts/node_sets.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/yade/solver/GrainSolver.hpp>

namespace yade {

YADE_PLUGIN((PlateController));

PlateController::~PlateController() = default;

void PlateController::action()
{
	const Real ratio    = follow(velocity, seenVelocity, drivenAt);
	auto&      assembly = GrainSolver::ofScene(*scene)->assembly;
	for (int plate : plates)
		flexpm::set_velocity(assembly, plate, { drivenAt[0], drivenAt[1] });
	for (int set : nodeSets)
		flexpm::set_motion_of(assembly, set, { drivenAt[0], drivenAt[1] }, { 0., 0., drivenAt[2] });
	for (int set : backSets)
		flexpm::set_motion_of(assembly, set, {}, { 0., 0., -drivenAt[2] });
	flexpm::drive_node_sets(assembly, scene->dt);
	if (undampedLoading && started && ratio != 1)
		flexpm::change_loading(assembly, ratio);
	else if ((elasticStart || undampedLoading) && !started)
		flexpm::start_elastically(assembly, undampedLoading, ofParts ? flexpm::Held::by_parts : flexpm::Held::by_ends);
	started = true;
	if (undampedLoading && ofParts) renew(assembly, true);
	flexpm::drive_node_sets(assembly, scene->dt); // those that float have got another velocity
}

} // namespace yade
