// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Views of a grain's nodes.
#include <flexpm/yade/grains/LaguerreCell.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/plane_lanes/rigid_grain.hpp>
#include <flexpm/kernel/space_lanes/solid_access.hpp>
#include <flexpm/kernel/space_lanes/solid_bodies.hpp>
#include <flexpm/kernel/space_lanes/tetrahedron_forces.hpp>
#include <flexpm/kernel/step/step.hpp>
#include <flexpm/yade/bindings/array_view.hpp>
#include <flexpm/yade/grains/AssemblyOwner.hpp>
#include <flexpm/yade/grains/LobattoContact.hpp>

namespace yade {

namespace py = boost::python;
using flexpm_bindings::Access;

YADE_PLUGIN((LaguerreCell));

namespace {

	/// (nodes, axes) view of the rows of one grain in a node array.
	template <class T> py::object nodeView(const OwnedAssembly& owned, int grain, const flexpm::Array<T>& values, Access access)
	{
		const auto&          grains = owned.grains();
		const std::ptrdiff_t row = grains.layout.axis_stride * sizeof(T), node = grains.layout.node_stride * sizeof(T);
		const T*             first = values.data() + grains.node(grain, 0);
		return flexpm_bindings::array_view(first, { grains.nodes_of(grain), grains.layout.dimension }, { node, row }, py::object(owned.engine), access);
	}

	template <class T> py::object nodeView(int grain, flexpm::Array<T> flexpm::Grains::*values, Access access)
	{
		const auto owned = assemblyOfGrain(grain);
		return nodeView(owned, grain, owned.grains().*values, access);
	}

	/// (nodes, 3) copy of a vector of each node, by vector(grains, node).
	template <class Vector> py::object nodeCopy(const flexpm::Grains& grains, int grain, Vector vector)
	{
		std::vector<double> all;
		for (int n = 0; n < grains.nodes_of(grain); ++n) {
			const flexpm::Vector v = vector(grains.node(grain, n));
			all.insert(all.end(), { v.x, v.y, v.z });
		}
		return flexpm_bindings::copied(all, 3, Access::readOnly);
	}

	py::object nodeCopy(const flexpm::Grains& grains, int grain, const flexpm::Array<double>& values)
	{
		return nodeCopy(grains, grain, [&](int node) { return grains.vector(values, node); });
	}

	/// The nodes of a rigid polyhedron follow from its motion: scripts get copies of what they have.
	bool isRigidPolyhedron(const OwnedAssembly& owned, int grain) { return owned.space && owned.space->grains.is_rigid(grain); }

	/// Call visit(nodes) for each tetrahedron of a grain with the numbers of its nodes, the centre first.
	template <class Visit> void forEachTetrahedron(const flexpm::SolidState& state, int grain, Visit visit)
	{
		const auto& grains = state.grains;
		flexpm::for_each_tetrahedron(state, grains.block_of(grain), [&](const auto&, std::array<int, 4> nodes) {
			for (int& n : nodes)
				n = (n - grains.node(grain, 0)) / grains.layout.node_stride;
			visit(nodes);
		});
	}

} // namespace

LaguerreCell::~LaguerreCell() { ++destroyedContacts(); }

py::object LaguerreCell::positions() const
{
	const auto owned = assemblyOfGrain(grain);
	if (owned.space) return nodeCopy(owned.space->grains, grain, [&](int node) { return owned.space->grains.position(node); });
	if (owned.plane->plan.shown_position.empty()) flexpm::show_positions(*owned.plane);
	return nodeView(owned, grain, owned.plane->plan.shown_position, Access::readOnly);
}

py::object LaguerreCell::displacements() const
{
	const auto owned = assemblyOfGrain(grain);
	if (isRigidPolyhedron(owned, grain)) return nodeCopy(owned.space->grains, grain, owned.space->grains.displacement);
	return nodeView(owned, grain, owned.grains().displacement, Access::readWrite);
}

py::object LaguerreCell::velocities() const
{
	const auto owned = assemblyOfGrain(grain);
	if (isRigidPolyhedron(owned, grain))
		return nodeCopy(owned.space->grains, grain, [&](int node) { return flexpm::node_velocity(*owned.space, grain, node); });
	return nodeView(owned, grain, owned.grains().velocity, Access::readWrite);
}

py::object LaguerreCell::forces() const
{
	const auto owned = assemblyOfGrain(grain);
	if (isRigidPolyhedron(owned, grain)) return nodeCopy(owned.space->grains, grain, flexpm::node_forces(*owned.space));
	return nodeView(owned, grain, owned.grains().force, Access::readOnly);
}

py::object LaguerreCell::held() const { return nodeView(grain, &flexpm::Grains::prescribed, Access::readWrite); }

py::list LaguerreCell::triangles() const
{
	const auto owned = assemblyOfGrain(grain);
	py::list   all;
	if (owned.space) {
		forEachTetrahedron(*owned.space, grain, [&](const auto& n) { all.append(py::make_tuple(n[1], n[2], n[3])); });
		return all;
	}
	const auto& grains = owned.plane->grains;
	for (int t = 0; t < flexpm::triangles_of(grains, grain); ++t) {
		const auto n = flexpm::triangle_nodes(grains, grain, t);
		all.append(py::make_tuple(n[0], n[1], n[2]));
	}
	return all;
}

py::list LaguerreCell::tetrahedra() const
{
	const auto owned = assemblyOfGrain(grain);
	py::list   all;
	if (owned.space) forEachTetrahedron(*owned.space, grain, [&](const auto& n) { all.append(py::make_tuple(n[0], n[1], n[2], n[3])); });
	return all;
}

bool LaguerreCell::rigid() const { return assemblyOfGrain(grain).grains().is_rigid(grain); }

int LaguerreCell::parentGrain() const { return assemblyOfGrain(grain).grains().parent[grain]; }

void LaguerreCell::setMotion(Vector3r velocity, Real spin) const
{
	const auto owned = assemblyOfGrain(grain);
	if (owned.space) flexpm::refuse("spin", spin, "rad/s", "must be a vector of three for a polyhedron; give (x, y, z)");
	flexpm::set_motion(owned.plane->grains, grain, { velocity[0], velocity[1] }, spin, Omega::instance().getScene()->dt);
}

void LaguerreCell::setSpaceMotion(Vector3r velocity, Vector3r spin) const
{
	const auto owned = assemblyOfGrain(grain);
	if (owned.plane) flexpm::refuse("spin", "a vector", "must be a number for a 2D grain; give the spin about z");
	flexpm::set_motion(*owned.space, grain, { velocity[0], velocity[1], velocity[2] }, { spin[0], spin[1], spin[2] });
}

int LaguerreCell::vertices() const { return assemblyOfGrain(grain).grains().vertices_of(grain); }

} // namespace yade
