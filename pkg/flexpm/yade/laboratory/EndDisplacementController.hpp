// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Driven ends of a rectangle of deformable grains: held and moved boundary nodes, paper Sec. 4.1.
#pragma once

#include <flexpm/yade/bindings/saved_class.hpp>
#include <flexpm/yade/laboratory/LoadingController.hpp>

namespace yade {

class EndDisplacementController : public LoadingController {
public:
	~EndDisplacementController() override;
	void action() override;
	void preload(Real share, int steps) override;
	void release() override;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(EndDisplacementController, LoadingController,
		"Fixes the bottom nodes of a rectangular specimen axially (a single node also laterally) and moves the top nodes; "
		"no friction on either. Place it before :yref:`GrainSolver`.",
		((Real, velocity, 0.,, "Velocity of the top at a velocity factor of 1, positive away from the bottom [m/s, or m per step with scaled masses]."))
		((bool, holdTop, true,, "Drive the top; otherwise only the bottom is fixed and the top is free."))
		((bool, elasticStart, true,, "Start all nodes with the velocities of the elastic solution, so that no wave runs through the specimen."))
		((bool, ofJoints, false,, "Joints may slide, which changes the velocities of the elastic solution: sliding contacts carry no shear there."))
		((bool, gripped, false, Attr::readonly, "The top is controlled |yupdate|."))
		((Real, seenVelocity, 0., Attr::hidden, "The velocity as set at the last step [m/s, or m per step]."))
		((Real, drivenAt, 0., Attr::hidden, "Present velocity of the top nodes [m/s, or m per step]."))
	);
	// clang-format on
};
REGISTER_SAVED(EndDisplacementController);

} // namespace yade
