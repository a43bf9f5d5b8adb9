// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Bounding box of a deformable grain.
#include <flexpm/yade/grains/LaguerreCell.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/yade/grains/AssemblyOwner.hpp>
#include <flexpm/yade/grains/Bo1_LaguerreCell_Aabb.hpp>

namespace yade {

YADE_PLUGIN((Bo1_LaguerreCell_Aabb));

Bo1_LaguerreCell_Aabb::~Bo1_LaguerreCell_Aabb() = default;

void Bo1_LaguerreCell_Aabb::go(const shared_ptr<Shape>& shape, shared_ptr<Bound>& bound, const Se3r&, const Body*)
{
	const int   grain = static_cast<const LaguerreCell&>(*shape).grain;
	const auto& a     = *assemblyOf(*scene);
	if (!bound) bound = boost::make_shared<Aabb>();
	const Real     r = a.grains.radius[grain];
	const auto     c = a.grains.position(a.grains.centre(grain));
	const Vector3r centre(c.x, c.y, 0);
	bound->min = centre - Vector3r(r, r, r);
	bound->max = centre + Vector3r(r, r, r);
	for (int n = 0; n < a.grains.nodes_of(grain); ++n) {
		const auto     p = a.grains.position(a.grains.node(grain, n));
		const Vector3r corner(p.x, p.y, 0);
		bound->min = bound->min.cwiseMin(corner);
		bound->max = bound->max.cwiseMax(corner);
	}
}

} // namespace yade
