// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Plates and pressure on the specimen, as scripts lay them on and take them off.
#include <flexpm/yade/solver/GrainSolver.hpp>

#include <flexpm/kernel/forces/plate_contact.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/laboratory/gauge.hpp>
#include <flexpm/kernel/topology/plate_build.hpp>

namespace yade {

py::list GrainSolver::addSidePlates(int side, int pieces, bool bonded, Real friction)
{
	py::list numbers;
	for (int plate : flexpm::add_side_plates(assembly, side, pieces, { 0, friction, bonded }))
		numbers.append(plate);
	return numbers;
}

int GrainSolver::addTouchingPlate(Vector3r normal, Real friction)
{
	return flexpm::add_touching_plate(assembly, { normal[0], normal[1] }, { 0, friction, false });
}

int GrainSolver::addPatchPlate(Vector3r place, Real length, Vector3r normal, Real friction, bool bonded)
{
	return flexpm::add_patch_plate(assembly, { { place[0], place[1] }, length, { normal[0], normal[1] } }, { 0, friction, bonded });
}

py::tuple GrainSolver::gaugePoints(Vector3r first, Vector3r second)
{
	const auto gauge = flexpm::gauge_points(current(), { first[0], first[1] }, { second[0], second[1] });
	return py::make_tuple(gauge.first, gauge.second, flexpm::gauge_length(assembly, gauge));
}

py::tuple GrainSolver::sectionNodes(Real place, Vector3r direction, Real width)
{
	const auto section = flexpm::section_at(current(), place, { direction[0], direction[1] }, width / 2);
	py::list   nodes;
	for (int node : section.nodes)
		nodes.append(node);
	return py::make_tuple(nodes, section.place);
}

void GrainSolver::fixTangential(int plate) { flexpm::fix_tangential(assembly, plate); }

int GrainSolver::addWall(Vector3r position, Vector3r normal, Real friction)
{
	return flexpm::add_wall(assembly, { position[0], position[1] }, { normal[0], normal[1] }, { 0, friction, false });
}

py::list GrainSolver::plates()
{
	const auto& a = current();
	py::list    all;
	for (std::size_t i = 0; i < a.plates.size(); ++i) {
		const flexpm::Plate& p = a.plates[i];
		py::dict             d;
		d["side"]          = p.side;
		d["normal"]        = py::make_tuple(p.normal.x, p.normal.y);
		d["width"]         = p.width;
		d["place"]         = py::make_tuple(p.position.x + p.displacement.x, p.position.y + p.displacement.y);
		d["work"]          = p.boundary_work;
		d["displacement"]  = py::make_tuple(p.displacement.x, p.displacement.y);
		d["velocity"]      = py::make_tuple(p.velocity.x, p.velocity.y);
		d["force"]         = py::make_tuple(p.force.x, p.force.y);
		d["contact_width"] = flexpm::contact_width(a, static_cast<int>(i));
		all.append(d);
	}
	return all;
}

void GrainSolver::clearPressure(int side) { flexpm::set_pressure(assembly, side, 0.); }

} // namespace yade
