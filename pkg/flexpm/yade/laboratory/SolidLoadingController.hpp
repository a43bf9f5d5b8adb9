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
		"It starts with the velocities of the elastic solution, so that no wave runs through the specimen, from where pressures have brought it; with real masses it moves only the loading parts. Place it before :yref:`GrainSolver`.",
		((Real, velocity, 0.,, "Velocity of the top at factor 1, positive away from the bottom, or of the plates along their direction [m/s, or m per step with scaled masses]."))
		((vector<int>, plates,,, "Numbers of the plates that move [-]."))
		((vector<int>, nodeSets,,, "Numbers of the node sets that move; neither: the top does [-]."))
		((vector<int>, backSets,,, "Indices of the node sets that rotate in the opposite sense [-]."))
		((Vector3r, direction, Vector3r::UnitZ(),, "Direction of these, or the axis of rotation of the node sets, a unit vector [-]."))
		((bool, turns, false,, "The node sets rotate about their positions, with the velocity as spin [rad/s, or rad per step]."))
		((bool, gripped, false, Attr::readonly, "It has begun to move |yupdate|."))
		((bool, preloaded, false, Attr::hidden, "All grains are prescribed along the elastic solution."))
		((Real, seenVelocity, 0., Attr::hidden, "The velocity as set at the last step [m/s, or m per step]."))
		((Real, drivenAt, 0., Attr::hidden, "Velocity that the top has [m/s, or m per step]."))
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
