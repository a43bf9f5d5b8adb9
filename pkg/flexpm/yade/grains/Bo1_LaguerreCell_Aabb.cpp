// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Bounding box of a deformable grain.
#include <flexpm/yade/grains/LaguerreCell.hpp>

#include <flexpm/yade/grains/AssemblyOwner.hpp>
#include <flexpm/yade/grains/Bo1_LaguerreCell_Aabb.hpp>

#include <atomic>

namespace yade {

CREATE_LOGGER(Bo1_LaguerreCell_Aabb);
YADE_PLUGIN((Bo1_LaguerreCell_Aabb));

Bo1_LaguerreCell_Aabb::~Bo1_LaguerreCell_Aabb() = default;

void Bo1_LaguerreCell_Aabb::reportOnce(int grain, Body::id_t body)
{
	static std::atomic_flag said = ATOMIC_FLAG_INIT;
	if (said.test_and_set()) return;
	LOG_ERROR(
	        "LaguerreCell.grain = " << grain << " of body " << body
	                                << ", must be a grain of the scene's solver; build the specimen first (flexpm.build). It touches nothing.");
}

void Bo1_LaguerreCell_Aabb::go(const shared_ptr<Shape>& shape, shared_ptr<Bound>& bound, const Se3r&, const Body* body)
{
	const int  grain = static_cast<const LaguerreCell&>(*shape).grain;
	const auto owned = findAssembly(*scene);
	// an exception would not leave YADE's parallel loop; without a bound the collider passes over the body
	if (!owned.engine || grain < 0 || grain >= owned.grains().count) return reportOnce(grain, body->getId());
	owned.showNodes();
	const auto& grains = owned.grains();
	if (!bound) bound = boost::make_shared<Aabb>();
	const Vector3r centre = toYade(grains.position(grains.centre(grain)));
	// a disc is as thick as wide; a polyhedron has its corners
	const Real r = owned.plane ? grains.radius[grain] : 0.;
	bound->min   = centre - Vector3r(r, r, r);
	bound->max   = centre + Vector3r(r, r, r);
	for (int n = 0; n < grains.nodes_of(grain); ++n) {
		const Vector3r corner = toYade(grains.position(grains.node(grain, n)));
		bound->min            = bound->min.cwiseMin(corner);
		bound->max            = bound->max.cwiseMax(corner);
	}
}

} // namespace yade
