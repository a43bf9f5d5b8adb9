// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Views of a grain's nodes.
#include <flexpm/yade/grains/LaguerreCell.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/motion/rigid_grain.hpp>
#include <flexpm/kernel/step/step.hpp>
#include <flexpm/yade/bindings/array_view.hpp>
#include <flexpm/yade/grains/AssemblyOwner.hpp>
#include <flexpm/yade/grains/LobattoContact.hpp>

namespace yade {

namespace py = boost::python;
using flexpm_bindings::Access;

YADE_PLUGIN((LaguerreCell));

namespace {

	/// (nodes, 2) view of the rows of one grain in a node array.
	template <class T> py::object nodeView(const OwnedAssembly& owned, int grain, const flexpm::Array<T>& values, Access access)
	{
		const auto&          grains = owned->grains;
		const std::ptrdiff_t row = grains.layout.axis_stride * sizeof(T), node = grains.layout.node_stride * sizeof(T);
		const T*             first = values.data() + grains.node(grain, 0);
		return flexpm_bindings::array_view(first, { grains.nodes_of(grain), grains.layout.dimension }, { node, row }, py::object(owned.engine), access);
	}

	template <class T> py::object nodeView(int grain, flexpm::Array<T> flexpm::Grains::*values, Access access)
	{
		const auto owned = assemblyOfGrain(grain);
		return nodeView(owned, grain, owned->grains.*values, access);
	}

} // namespace

LaguerreCell::~LaguerreCell() { ++destroyedContacts(); }

py::object LaguerreCell::positions() const
{
	const auto owned = assemblyOfGrain(grain);
	if (owned->plan.shown_position.empty()) flexpm::show_positions(*owned);
	return nodeView(owned, grain, owned->plan.shown_position, Access::readOnly);
}

py::object LaguerreCell::displacements() const { return nodeView(grain, &flexpm::Grains::displacement, Access::readWrite); }

py::object LaguerreCell::velocities() const { return nodeView(grain, &flexpm::Grains::velocity, Access::readWrite); }

py::object LaguerreCell::forces() const { return nodeView(grain, &flexpm::Grains::force, Access::readOnly); }

py::object LaguerreCell::held() const { return nodeView(grain, &flexpm::Grains::prescribed, Access::readWrite); }

py::list LaguerreCell::triangles() const
{
	const auto& grains = assemblyOfGrain(grain)->grains;
	py::list    all;
	for (int t = 0; t < flexpm::triangles_of(grains, grain); ++t) {
		const auto n = flexpm::triangle_nodes(grains, grain, t);
		all.append(py::make_tuple(n[0], n[1], n[2]));
	}
	return all;
}

bool LaguerreCell::rigid() const { return assemblyOfGrain(grain)->grains.is_rigid(grain); }

int LaguerreCell::parentGrain() const { return assemblyOfGrain(grain)->grains.parent[grain]; }

void LaguerreCell::setMotion(Vector3r velocity, Real spin) const
{
	flexpm::set_motion(assemblyOfGrain(grain)->grains, grain, { velocity[0], velocity[1] }, spin, Omega::instance().getScene()->dt);
}

int LaguerreCell::vertices() const { return assemblyOfGrain(grain)->grains.vertices_of(grain); }

} // namespace yade
