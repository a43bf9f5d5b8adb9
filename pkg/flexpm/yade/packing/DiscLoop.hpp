// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The interaction loop of a packing of discs or spheres, paper Sec. 3.1.
#pragma once

#include <flexpm/kernel/geometry/disc_repulsion.hpp>
#include <flexpm/yade/abi/yade_lite.hpp>
#include <flexpm/yade/bindings/saved_class.hpp>

namespace yade {

class DiscLoop : public InteractionLoop {
public:
	~DiscLoop() override;
	void action() override;

private:
	/// What the loop keeps of an interaction, to go without YADE's objects.
	struct Row {
		shared_ptr<Interaction> interaction;   ///< held, so that no other can take its address
		bool                    plain = false; ///< of two spheres, without shear stiffness
		int                     first = 0, second = 0;
		flexpm::DiscPair        pair;
	};

	std::vector<Row>            rows;   // as the scene's interactions
	std::vector<flexpm::Vector> places; // of all bodies

	void updateScene();
	void readPlaces();
	Row  makeRow(const shared_ptr<Interaction>& interaction) const;
	/// Add a plain row's push to the forces; false if the pair begins or ceases to touch.
	bool push(const Row& row);
	/// What InteractionLoop does with one interaction.
	void dispatch(const shared_ptr<Interaction>& interaction);

public:
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(DiscLoop, InteractionLoop,
		"An :yref:`InteractionLoop` for packings of :yref:`spheres<Sphere>` that do not rotate, in 2D or 3D, without friction, under "
		":yref:`Law2_ScGeom_FrictPhys_CundallStrack`: the same forces to the last bit, from packed arrays. Pairs that begin or cease to touch, walls, "
		"and contacts with a shear stiffness go through the functors. Radii and stiffnesses must not change while a pair stays as it is; one thread, "
		":yref:`InsertionSortCollider`; no periodic cell, detection factor, sorting, energy tracking or :yref:`callbacks<InteractionLoop.callbacks>`.",
		((bool, mirror, true,, "Write the normal force of each contact into :yref:`NormPhys.normalForce`, where scripts can read it. :yref:`ScGeom` keeps the values from the creation of the contact. Needed if scripts erase interactions."))
	);
	// clang-format on
};
REGISTER_SAVED(DiscLoop);

} // namespace yade
