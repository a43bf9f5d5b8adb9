// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Driven ends of a solid, whose grains deform or are rigid, paper Sec. 4.1 in space.
#pragma once

#include <flexpm/kernel/statics/solid_field.hpp>
#include <flexpm/yade/bindings/saved_class.hpp>
#include <flexpm/yade/laboratory/LoadingController.hpp>

namespace yade {

class GrainSolver;

class SolidLoadingController : public LoadingController {
public:
	~SolidLoadingController() override;
	void action() override;
	void preload(Real share, int steps) override;
	void release() override;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(SolidLoadingController, LoadingController,
		"Moves the top of a 3D specimen along z after :yref:`GrainSolver.holdEnds`, or plates and node sets of :yref:`GrainSolver.layLine`, layPatch and addNodeSet. "
		"All grains start with the velocities of the elastic solution from the state under the present pressures, so that no wave runs through the specimen; with real masses only the loading parts start to move. Place it before :yref:`GrainSolver`.",
		((Real, velocity, 0.,, "Velocity of the top at factor 1, positive away from the bottom, or of the plates along their direction [m/s, or m per step with scaled masses]."))
		((vector<int>, plates,,, "Indices of the plates that move [-]."))
		((vector<int>, nodeSets,,, "Indices of the node sets that move; without plates and sets the top moves [-]."))
		((vector<int>, backSets,,, "Indices of the node sets that rotate in the opposite sense [-]."))
		((Vector3r, direction, Vector3r::UnitZ(),, "Direction of the plates and node sets, or the axis of rotation of the node sets, a unit vector [-]."))
		((bool, turns, false,, "The node sets rotate about their positions, with the velocity as spin [rad/s, or rad per step]."))
		((bool, gripped, false, Attr::readonly, "The motion has begun |yupdate|."))
		((bool, preloaded, false, Attr::hidden, "All grains are prescribed along the elastic solution."))
		((Real, seenVelocity, 0., Attr::hidden, "The velocity as set at the last step [m/s, or m per step]."))
		((Real, drivenAt, 0., Attr::hidden, "Present velocity of the top [m/s, or m per step]."))
	);
	// clang-format on

private:
	static flexpm::SolidState& stateOf(GrainSolver& solver);
	flexpm::SolidDrive         driveOfParts() const;
	flexpm::SolidDrive         driveOf(const flexpm::SolidState& state) const;
	/// Its elastic solution.
	flexpm::SolidField fieldOf(const flexpm::SolidState& state, int threads) const;
};
REGISTER_SAVED(SolidLoadingController);

} // namespace yade
