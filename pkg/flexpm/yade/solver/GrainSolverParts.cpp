// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Soft machines, gauges, node sets, held sides and pressures, and what plates and node sets bear, in 2D and 3D.
#include <flexpm/yade/solver/GrainSolver.hpp>

#include <flexpm/kernel/forces/held_sides.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/forces/solid_pressure.hpp>
#include <flexpm/kernel/laboratory/gauge.hpp>
#include <flexpm/kernel/laboratory/solid_ends.hpp>
#include <flexpm/kernel/parts/node_sets.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/parts/solid_plates.hpp>

namespace yade {

namespace {

	/// Tuple of as many components as the grains' vectors have.
	py::tuple tupleOf(const flexpm::Grains& grains, flexpm::Vector v)
	{
		return grains.layout.dimension == 2 ? py::make_tuple(v.x, v.y) : py::make_tuple(v.x, v.y, v.z);
	}

	/// An angle or a moment: in 2D a number, about z.
	py::object turnOf(const flexpm::Grains& grains, flexpm::Vector v)
	{
		return grains.layout.dimension == 2 ? py::object(v.z) : py::make_tuple(v.x, v.y, v.z);
	}

} // namespace

void GrainSolver::setMachine(int plate, Real stiffness)
{
	onState([&](auto& state) { flexpm::set_machine(state, plate, stiffness); });
}

py::tuple GrainSolver::gaugePoints(Vector3r first, Vector3r second)
{
	current();
	const auto gauge = flexpm::gauge_points(grains(), fromYade(first), fromYade(second));
	return py::make_tuple(gauge.first, gauge.second, flexpm::gauge_length(grains(), gauge));
}

py::tuple GrainSolver::sectionNodes(Real place, Vector3r direction, Real width)
{
	current();
	const auto section = flexpm::section_at(grains(), place, fromYade(direction), width / 2);
	py::list   nodes;
	for (int node : section.nodes)
		nodes.append(node);
	return py::make_tuple(nodes, section.place);
}

py::tuple GrainSolver::nodePlaces(bool bonded)
{
	current();
	const auto          nodes = flexpm::holdable_nodes(state());
	const int           axes  = dimension();
	std::vector<double> places;
	for (int node : nodes) {
		const auto   p        = bonded ? grains().vector(grains().reference, node) : grains().position(node);
		const double values[] = { p.x, p.y, p.z };
		places.insert(places.end(), values, values + axes);
	}
	return py::make_tuple(flexpm_bindings::copied(nodes, 0), flexpm_bindings::copied(places, axes));
}

int GrainSolver::addNodeSet(vector<int> nodes, bool x, bool y, bool z)
{
	current();
	return onState([&](auto& state) { return flexpm::add_node_set(state, nodes, { x, y, z && solid() }); });
}

void GrainSolver::turnNodeSet(int set, py::object about)
{
	if (about.is_none()) return flexpm::let_float(state(), set);
	const Vector3r pivot = py::extract<Vector3r>(about);
	flexpm::set_pivot(state(), set, fromYade(pivot));
}

void GrainSolver::moveNodeSet(int set, Vector3r velocity, Vector3r spin)
{
	const Real dt = Omega::instance().getScene()->dt;
	if (solid()) {
		flexpm::set_motion_of(space, set, fromYade(velocity), fromYade(spin));
		flexpm::drive_node_sets(space, dt);
		flexpm::promise_work(space, dt);
		return;
	}
	flexpm::set_motion_of(assembly, set, { velocity[0], velocity[1] }, { 0., 0., velocity[2] + spin[2] });
	flexpm::drive_node_sets(assembly, dt);
}

py::list GrainSolver::nodeSets()
{
	current();
	py::list all;
	for (const flexpm::NodeSet& set : state().node_sets) {
		py::dict d;
		d["nodes"]        = flexpm_bindings::copied(set.nodes, 0);
		d["axes"]         = string(set.holds_x ? "x" : "") + (set.holds_y ? "y" : "") + (set.holds_z ? "z" : "");
		d["floats"]       = set.floats;
		d["place"]        = tupleOf(grains(), set.pivot);
		d["displacement"] = tupleOf(grains(), set.displacement);
		d["angle"]        = turnOf(grains(), set.angle);
		d["force"]        = tupleOf(grains(), set.force);
		d["moment"]       = turnOf(grains(), set.moment);
		d["work"]         = set.work;
		all.append(d);
	}
	return all;
}

void GrainSolver::holdSide(int side, bool x, bool y, bool z)
{
	current();
	const bool axes[] = { x, y, z };
	for (int axis = 0; axis < dimension(); ++axis)
		if (axes[axis]) onState([&](auto& state) { flexpm::hold_side(state, side, axis); });
}

py::list GrainSolver::plates()
{
	current();
	py::list all;
	for (std::size_t i = 0; i < state().plates.size(); ++i) {
		const flexpm::Plate& p      = state().plates[i];
		const int            number = static_cast<int>(i);
		py::dict             d;
		d["side"]          = p.side;
		d["normal"]        = tupleOf(grains(), p.normal);
		d["friction"]      = p.friction;
		d["bonded"]        = p.bonded;
		d["pressed"]       = p.loaded;
		d["place"]         = tupleOf(grains(), p.position + p.displacement);
		d["work"]          = p.boundary_work;
		d["displacement"]  = tupleOf(grains(), p.displacement);
		d["velocity"]      = tupleOf(grains(), p.velocity);
		d["force"]         = tupleOf(grains(), p.force);
		d["strip"]         = p.strip;
		d["radius"]        = p.jaw_radius;
		d["machine"]       = p.machine_stiffness;
		d["machine_give"]  = p.machine_give;
		d["seated"]        = p.seated;
		d["angle"]         = turnOf(grains(), p.turn);
		d["contact_angle"] = onState([&](const auto& state) { return flexpm::contact_angle(state, number); });
		d["area"]          = p.face_area;
		if (solid()) {
			d["pressed_area"] = flexpm::pressed_area(p);
		} else {
			d["width"]         = p.width;
			d["middle"]        = tupleOf(grains(), flexpm::middle_of_face(assembly, p));
			d["contact_width"] = flexpm::contact_width(assembly, number);
		}
		all.append(d);
	}
	return all;
}

void GrainSolver::clearPressure(int side)
{
	onState([&](auto& state) { flexpm::set_pressure(state, side, 0.); });
}

} // namespace yade
