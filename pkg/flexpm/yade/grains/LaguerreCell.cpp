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
	template <class T> py::object nodeView(int grain, flexpm::Array<T> flexpm::Assembly::*values, Access access)
	{
		const auto           owned = assemblyOfGrain(grain);
		const auto&          a     = *owned;
		const std::ptrdiff_t row   = flexpm::lanes * sizeof(T);
		const T*             first = (a.*values).data() + a.node(grain, 0);
		return flexpm_bindings::array_view(first, { a.nodes_of(grain), 2 }, { 2 * row, row }, py::object(owned.engine), access);
	}

} // namespace

LaguerreCell::~LaguerreCell() { ++destroyedContacts(); }

py::object LaguerreCell::positions() const
{
	auto& a = *assemblyOfGrain(grain);
	if (a.shown_position.empty()) flexpm::show_positions(a);
	return nodeView(grain, &flexpm::Assembly::shown_position, Access::readOnly);
}

py::object LaguerreCell::displacements() const { return nodeView(grain, &flexpm::Assembly::displacement, Access::readWrite); }

py::object LaguerreCell::velocities() const { return nodeView(grain, &flexpm::Assembly::velocity, Access::readWrite); }

py::object LaguerreCell::forces() const { return nodeView(grain, &flexpm::Assembly::force, Access::readOnly); }

py::object LaguerreCell::held() const { return nodeView(grain, &flexpm::Assembly::held, Access::readWrite); }

py::list LaguerreCell::triangles() const
{
	const auto& a = *assemblyOfGrain(grain);
	py::list    all;
	for (int t = 0; t < flexpm::triangles_of(a, grain); ++t) {
		const auto n = flexpm::triangle_nodes(a, grain, t);
		all.append(py::make_tuple(n[0], n[1], n[2]));
	}
	return all;
}

bool LaguerreCell::rigid() const { return assemblyOfGrain(grain)->is_rigid(grain); }

int LaguerreCell::aggregate() const { return assemblyOfGrain(grain)->aggregate[grain]; }

void LaguerreCell::setMotion(Vector3r velocity, Real spin) const
{
	flexpm::set_motion(*assemblyOfGrain(grain), grain, { velocity[0], velocity[1] }, spin, Omega::instance().getScene()->dt);
}

int LaguerreCell::vertices() const
{
	const auto& a = *assemblyOfGrain(grain);
	return a.group(a.grain_slot[grain] / flexpm::lanes).vertices;
}

} // namespace yade
