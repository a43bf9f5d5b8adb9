// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Plates, node sets and pressure on the specimen, as scripts lay them on and take them off.
#include <flexpm/yade/solver/GrainSolver.hpp>

#include <flexpm/kernel/forces/held_sides.hpp>
#include <flexpm/kernel/parts/node_sets.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/laboratory/gauge.hpp>
#include <flexpm/kernel/topology/part_plates.hpp>
#include <flexpm/kernel/topology/plate_build.hpp>

namespace yade {

py::list GrainSolver::addSidePlates(int side, int pieces, bool bonded, Real friction, Real strip, bool seated)
{
	py::list numbers;
	for (int plate : flexpm::add_side_plates(assembly, side, pieces, { 0, friction, bonded, strip, seated }))
		numbers.append(plate);
	return numbers;
}

int GrainSolver::addTouchingPlate(Vector3r normal, Real friction)
{
	return flexpm::add_touching_plate(assembly, { normal[0], normal[1] }, { 0, friction, false });
}

int GrainSolver::addPatchPlate(Vector3r place, Real length, Vector3r normal, Real friction, bool bonded, Real strip, bool seated)
{
	return flexpm::add_patch_plate(assembly, { { place[0], place[1] }, length, { normal[0], normal[1] } }, { 0, friction, bonded, strip, seated });
}

int GrainSolver::findSidePlate(int side, bool bonded, Real friction, Real strip, bool seated)
{
	return flexpm::find_side_plate(current(), side, { 0, friction, bonded, strip, seated });
}

int GrainSolver::findPatchPlate(Vector3r place, Real length, Vector3r normal, Real friction, bool bonded, Real strip, bool seated)
{
	return flexpm::find_patch_plate(current(), { { place[0], place[1] }, length, { normal[0], normal[1] } }, { 0, friction, bonded, strip, seated });
}

int GrainSolver::addJawPlate(Vector3r place, Vector3r centre, Real radius, Real angle, Real friction, Real strip)
{
	return flexpm::add_jaw_plate(assembly, { { place[0], place[1] }, { centre[0], centre[1] }, radius, angle }, { 0, friction, false, strip });
}

int GrainSolver::findJawPlate(Vector3r place, Vector3r centre, Real radius, Real angle, Real friction, Real strip)
{
	return flexpm::find_jaw_plate(current(), { { place[0], place[1] }, { centre[0], centre[1] }, radius, angle }, { 0, friction, false, strip });
}

void GrainSolver::setMachine(int plate, Real stiffness) { flexpm::set_machine(assembly, plate, stiffness); }

py::tuple GrainSolver::gaugePoints(Vector3r first, Vector3r second)
{
	const auto gauge = flexpm::gauge_points(current().grains, { first[0], first[1] }, { second[0], second[1] });
	return py::make_tuple(gauge.first, gauge.second, flexpm::gauge_length(assembly.grains, gauge));
}

py::tuple GrainSolver::sectionNodes(Real place, Vector3r direction, Real width)
{
	const auto section = flexpm::section_at(current().grains, place, { direction[0], direction[1] }, width / 2);
	py::list   nodes;
	for (int node : section.nodes)
		nodes.append(node);
	return py::make_tuple(nodes, section.place);
}

void GrainSolver::fixTangential(int plate) { flexpm::fix_tangential(assembly, plate); }

py::tuple GrainSolver::nodePlaces(bool bonded)
{
	const auto          nodes = flexpm::holdable_nodes(current());
	std::vector<double> places;
	for (int node : nodes) {
		const auto p = bonded ? assembly.grains.reference_at(node) : assembly.grains.point_at(node);
		places.insert(places.end(), { p.x, p.y });
	}
	return py::make_tuple(flexpm_bindings::copied(nodes, 0), flexpm_bindings::copied(places, 2));
}

int GrainSolver::addNodeSet(vector<int> nodes, bool x, bool y) { return flexpm::add_node_set(current(), nodes, x, y); }

void GrainSolver::turnNodeSet(int set, py::object about)
{
	if (about.is_none()) return flexpm::let_float(assembly, set);
	const Vector3r pivot = py::extract<Vector3r>(about);
	flexpm::set_pivot(assembly, set, { pivot[0], pivot[1] });
}

void GrainSolver::moveNodeSet(int set, Vector3r velocity)
{
	flexpm::set_motion_of(assembly, set, { velocity[0], velocity[1] }, velocity[2]);
	flexpm::drive_node_sets(assembly, Omega::instance().getScene()->dt);
}

py::list GrainSolver::nodeSets()
{
	py::list all;
	for (const flexpm::NodeSet& set : current().node_sets) {
		py::dict d;
		d["nodes"]        = flexpm_bindings::copied(set.nodes, 0);
		d["axes"]         = string(set.holds_x ? "x" : "") + (set.holds_y ? "y" : "");
		d["floats"]       = set.floats;
		d["place"]        = py::make_tuple(set.pivot.x, set.pivot.y);
		d["displacement"] = py::make_tuple(set.displacement.x, set.displacement.y);
		d["angle"]        = set.angle.z;
		d["force"]        = py::make_tuple(set.force.x, set.force.y);
		d["moment"]       = set.moment.z;
		d["work"]         = set.work;
		all.append(d);
	}
	return all;
}

void GrainSolver::holdSide(int side, bool x, bool y)
{
	if (x) flexpm::hold_side(current(), side, 0);
	if (y) flexpm::hold_side(current(), side, 1);
}

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
		d["area"]          = a.area_of(p.width);
		d["friction"]      = p.friction;
		d["bonded"]        = p.bonded;
		d["pressed"]       = p.loaded;
		d["place"]         = py::make_tuple(p.position.x + p.displacement.x, p.position.y + p.displacement.y);
		const auto middle  = flexpm::middle_of_face(a, p);
		d["middle"]        = py::make_tuple(middle.x, middle.y);
		d["work"]          = p.boundary_work;
		d["displacement"]  = py::make_tuple(p.displacement.x, p.displacement.y);
		d["velocity"]      = py::make_tuple(p.velocity.x, p.velocity.y);
		d["force"]         = py::make_tuple(p.force.x, p.force.y);
		d["strip"]         = p.strip;
		d["radius"]        = p.jaw_radius;
		d["machine"]       = p.machine_stiffness;
		d["machine_give"]  = p.machine_give;
		d["seated"]        = p.seated;
		d["angle"]         = p.turn.z;
		d["contact_angle"] = flexpm::contact_angle(a, static_cast<int>(i));
		d["contact_width"] = flexpm::contact_width(a, static_cast<int>(i));
		all.append(d);
	}
	return all;
}

void GrainSolver::clearPressure(int side) { flexpm::set_pressure(assembly, side, 0.); }

} // namespace yade
