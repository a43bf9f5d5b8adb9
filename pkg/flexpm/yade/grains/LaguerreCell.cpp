// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Views of a grain's nodes.
#include <flexpm/yade/grains/LaguerreCell.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/motion/rigid_grain.hpp>
#include <flexpm/kernel/step/step.hpp>
#include <flexpm/yade/grains/LobattoContact.hpp>
#include <flexpm/yade/solver/GrainSolver.hpp>

namespace yade {

namespace py = boost::python;
using flexpm_bindings::Access;

YADE_PLUGIN((LaguerreCell));

namespace {

	/// (nodes, 2) view of the rows of one grain in a node array.
	template <class T> py::object nodeView(const shared_ptr<GrainSolver>& solver, int grain, const flexpm::Array<T>& values, Access access)
	{
		const auto&          a   = solver->assembly;
		const std::ptrdiff_t row = flexpm::lanes * sizeof(T);
		return flexpm_bindings::array_view(values.data() + a.node(grain, 0), { a.nodes_of(grain), 2 }, { 2 * row, row }, py::object(solver), access);
	}

} // namespace

LaguerreCell::~LaguerreCell() { ++destroyedContacts(); }

py::object LaguerreCell::positions() const
{
	const auto solver = GrainSolver::ofGrain(grain);
	if (solver->assembly.shown_position.empty()) flexpm::show_positions(solver->assembly);
	return nodeView(solver, grain, solver->assembly.shown_position, Access::readOnly);
}

py::object LaguerreCell::displacements() const
{
	const auto solver = GrainSolver::ofGrain(grain);
	return nodeView(solver, grain, solver->assembly.displacement, Access::readWrite);
}

py::object LaguerreCell::velocities() const
{
	const auto solver = GrainSolver::ofGrain(grain);
	return nodeView(solver, grain, solver->assembly.velocity, Access::readWrite);
}

py::object LaguerreCell::forces() const
{
	const auto solver = GrainSolver::ofGrain(grain);
	return nodeView(solver, grain, solver->assembly.force, Access::readOnly);
}

py::object LaguerreCell::held() const
{
	const auto solver = GrainSolver::ofGrain(grain);
	return nodeView(solver, grain, solver->assembly.held, Access::readWrite);
}

py::list LaguerreCell::triangles() const
{
	const auto& a = GrainSolver::ofGrain(grain)->assembly;
	py::list    all;
	for (int t = 0; t < flexpm::triangles_of(a, grain); ++t) {
		const auto n = flexpm::triangle_nodes(a, grain, t);
		all.append(py::make_tuple(n[0], n[1], n[2]));
	}
	return all;
}

bool LaguerreCell::rigid() const { return GrainSolver::ofGrain(grain)->assembly.is_rigid(grain); }

int LaguerreCell::aggregate() const { return GrainSolver::ofGrain(grain)->assembly.aggregate[grain]; }

void LaguerreCell::setMotion(Vector3r velocity, Real spin) const
{
	const auto solver = GrainSolver::ofGrain(grain);
	flexpm::set_motion(solver->assembly, grain, { velocity[0], velocity[1] }, spin, Omega::instance().getScene()->dt);
}

int LaguerreCell::vertices() const
{
	const auto& a = GrainSolver::ofGrain(grain)->assembly;
	return a.group(a.grain_slot[grain] / flexpm::lanes).vertices;
}

} // namespace yade
