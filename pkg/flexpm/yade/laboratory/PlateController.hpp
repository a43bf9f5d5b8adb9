// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  What moves the rigid plates and node sets of a test at a velocity, paper Sec. 4.1.
#pragma once

#include <flexpm/yade/bindings/saved_class.hpp>
#include <flexpm/yade/laboratory/LoadingController.hpp>

namespace yade {

class PlateController : public LoadingController {
public:
	~PlateController() override;
	void action() override;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(PlateController, LoadingController,
		"Moves rigid plates and node sets of :yref:`GrainSolver` at a velocity; :yref:`PressureController` applies pressures to plates. "
		"Place it before :yref:`GrainSolver`.",
		((vector<int>, plates,,, "Indices of the plates, from GrainSolver.addSidePlates or addTouchingPlate [-]."))
		((vector<int>, nodeSets,,, "Indices of the node sets that have the velocity and spin, from GrainSolver.addNodeSet [-]."))
		((vector<int>, backSets,,, "Indices of the node sets that rotate in the opposite sense [-]."))
		((Vector3r, velocity, Vector3r::Zero(),, "Velocity of plates and node sets along x and y at factor 1 [m/s, or m per step with scaled masses]; z: spin of the sets [rad/s]."))
		((bool, elasticStart, false,, "Start all grains with the velocities of the elastic solution for the plates' velocity, so that no wave runs through the specimen."))
		((bool, ofParts, false,, "The plates are supports on parts of the outline, which alone fix the specimen in the elastic solution; joints that the loading opens carry no load there."))
		((Vector3r, seenVelocity, Vector3r::Zero(), Attr::hidden, "The velocity as set at the last step [m/s, or m per step]."))
		((Vector3r, drivenAt, Vector3r::Zero(), Attr::hidden, "Present velocity of the plates [m/s, or m per step]."))
		((bool, started, false, Attr::readonly, "The elastic velocities are set |yupdate|."))
	);
	// clang-format on
};
REGISTER_SAVED(PlateController);

} // namespace yade
