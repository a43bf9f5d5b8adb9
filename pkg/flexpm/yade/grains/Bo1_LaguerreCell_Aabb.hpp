// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Bounding box of a deformable grain, for YADE's collider.
#pragma once

#include <flexpm/yade/abi/yade_lite.hpp>
#include <flexpm/yade/bindings/saved_class.hpp>

namespace yade {

class Bo1_LaguerreCell_Aabb : public BoundFunctor {
public:
	~Bo1_LaguerreCell_Aabb() override;
	void go(const shared_ptr<Shape>&, shared_ptr<Bound>&, const Se3r&, const Body*) override;
	FUNCTOR1D(LaguerreCell);
	// clang-format off
	YADE_CLASS_BASE_DOC(Bo1_LaguerreCell_Aabb, BoundFunctor,
		"Creates the bounding box of a :yref:`LaguerreCell` around its nodes; in 2D also around its disc, with the thickness of a sphere of this radius.");
	// clang-format on
	DECLARE_LOGGER;

private:
	/// Log that a body is no grain of the scene, for the first one.
	static void reportOnce(int grain, Body::id_t body);
};
REGISTER_SAVED(Bo1_LaguerreCell_Aabb);

} // namespace yade
