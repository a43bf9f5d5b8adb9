// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  What Python asks of the solver: energies, counts, arrays.
#include <flexpm/yade/solver/GrainSolver.hpp>
#include <flexpm/yade/solver/snapshot_dict.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/laboratory/solid_ends.hpp>
#include <flexpm/kernel/laboratory/solid_frame.hpp>
#include <flexpm/kernel/laboratory/test_frame.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/measure/grain_parting.hpp>
#include <flexpm/kernel/measure/mean_stress.hpp>
#include <flexpm/kernel/measure/overlaps.hpp>
#include <flexpm/kernel/measure/solid_overlaps.hpp>
#include <flexpm/kernel/space_lanes/tetrahedron_forces.hpp>
#include <flexpm/kernel/statics/elastic_constants.hpp>

#include <algorithm>

namespace yade {

using flexpm_bindings::copied;

py::tuple GrainSolver::elasticConstants()
{
	current();
	const auto e = solid() ? flexpm::constants_between_ends(space) : flexpm::elastic_constants(assembly);
	return py::make_tuple(e.youngs_modulus, e.poissons_ratio);
}

Real GrainSolver::crossingSteps(Real diameter)
{
	const Real dt = Omega::instance().getScene()->dt;
	return solid() ? flexpm::ball_crossing_steps(space, diameter, dt) : flexpm::disc_scales(assembly, diameter, dt).crossing_steps;
}

py::dict GrainSolver::energies()
{
	current();
	const auto e = onState([](const auto& state) { return flexpm::energies(state); });
	py::dict   d;
	d["kinetic_energy"]   = e.kinetic;
	d["elastic_energy"]   = e.elastic;
	d["damage_energy"]    = e.damage;
	d["friction_energy"]  = e.friction;
	d["damping_energy"]   = e.damping;
	d["drag_energy"]      = e.drag;
	d["erased_energy"]    = e.erased;
	d["boundary_work"]    = e.boundary_work;
	d["potential_energy"] = e.potential;
	d["initial_energy"]   = e.initial;
	return d;
}

py::tuple GrainSolver::cracks()
{
	current();
	const auto count = onState([](const auto& state) { return flexpm::count_cracks(state); });
	return py::make_tuple(count.tensile, count.shear);
}

py::tuple GrainSolver::wallForces(vector<int> grains)
{
	std::vector<char> inside(current().grains.count, 0);
	for (int grain : grains) {
		if (grain < 0 || grain >= assembly.grains.count) flexpm::refuse("wallForces: grain", grain, "", "must be the index of a grain; correct it");
		inside[grain] = 1;
	}
	const auto found = flexpm::forces_on_wall(assembly, inside);
	py::list   nodes, forces;
	for (std::size_t i = 0; i < found.nodes.size(); ++i) {
		nodes.append(found.nodes[i]);
		forces.append(Vector3r(found.forces[i].x, found.forces[i].y, 0));
	}
	return py::make_tuple(nodes, forces);
}

py::dict GrainSolver::parting()
{
	const auto found = flexpm::find_parting(current());
	py::dict   d;
	d["any"]      = found.any;
	d["standing"] = found.standing;
	d["loose"]    = found.loose;
	return d;
}

namespace {

	py::dict countsOf(const flexpm::SolidState& state)
	{
		const auto& grains = state.grains;
		int         nodes = 0, tetrahedra = 0;
		for (int grain = 0; grain < grains.count; ++grain)
			nodes += grains.nodes_of(grain);
		for (int block = 0; block < grains.blocks(); ++block)
			flexpm::for_each_tetrahedron(state, block, [&](auto&&...) { ++tetrahedra; });
		py::dict d;
		d["grains"]         = grains.count;
		d["particles"]      = grains.count;
		d["contacts"]       = state.contacts.count;
		d["inner_contacts"] = 0;
		d["nodes"]          = nodes;
		d["tetrahedra"]     = tetrahedra;
		return d;
	}

	py::dict deepestOverlap(const flexpm::SolidState& state)
	{
		const auto found = flexpm::largest_overlap(state);
		py::dict   d;
		d["depth"]       = found.depth;
		d["of_diameter"] = found.of_diameter;
		d["grains"]      = py::make_tuple(found.pair[0], found.pair[1]);
		d["pairs"]       = found.pairs;
		d["clearance"]   = found.clearance;
		return d;
	}

} // namespace

py::dict GrainSolver::counts()
{
	if (solid()) return countsOf(space);
	const auto& a        = current();
	const auto  grains   = flexpm::count_grains(a.grains);
	const auto  contacts = flexpm::count_contacts(a);
	py::dict    d;
	d["grains"]         = grains.grains;
	d["particles"]      = grains.particles;
	d["contacts"]       = contacts.between; // as in the specimen; others have touched since
	d["inner_contacts"] = contacts.within;
	d["touching"]       = contacts.touching;
	d["nodes"]          = grains.nodes;
	d["triangles"]      = grains.triangles;
	d["groups"]         = a.grains.groups.size();
	d["edges"]          = flexpm::count_facets(a);
	return d;
}

py::dict GrainSolver::overlaps(Real smallestPart)
{
	if (solid()) return deepestOverlap(space);
	std::vector<std::int32_t> grains;
	std::vector<std::uint8_t> bonded, facing;
	std::vector<double>       area, part, closed;
	for (const auto& o : flexpm::find_overlaps(current(), smallestPart)) {
		grains.insert(grains.end(), o.pair.begin(), o.pair.end());
		bonded.push_back(o.bonded);
		facing.push_back(o.facing);
		area.push_back(o.area);
		part.push_back(o.part);
		closed.push_back(o.closed);
	}
	py::dict d;
	d["grains"] = copied(grains, 2);
	d["area"]   = copied(area, 0);
	d["part"]   = copied(part, 0);
	d["bonded"] = copied(bonded, 0);
	d["facing"] = copied(facing, 0);
	d["closed"] = copied(closed, 0);
	return d;
}

py::dict GrainSolver::pairs()
{
	std::vector<std::int32_t> grains, face;
	std::vector<double>       force, place, normalForce, area, depth, clearance, friction, elastic;
	const auto                push = [](std::vector<double>& to, const flexpm::Vector& v) { to.insert(to.end(), { v.x, v.y, v.z }); };
	for (const auto& pair : space.pairs) {
		grains.insert(grains.end(), pair.grains.begin(), pair.grains.end());
		face.push_back(pair.face);
		push(force, pair.force);
		push(place, pair.place);
		normalForce.push_back(pair.normal_force);
		area.push_back(pair.area);
		depth.push_back(pair.depth);
		clearance.push_back(pair.clearance);
		friction.push_back(pair.friction_energy);
		elastic.push_back(pair.elastic_energy);
	}
	py::dict d;
	d["grains"]          = copied(grains, 2);
	d["contact"]         = copied(face, 0);
	d["force"]           = copied(force, 3);
	d["position"]        = copied(place, 3);
	d["normal_force"]    = copied(normalForce, 0);
	d["area"]            = copied(area, 0);
	d["depth"]           = copied(depth, 0);
	d["clearance"]       = copied(clearance, 0);
	d["friction_energy"] = copied(friction, 0);
	d["elastic_energy"]  = copied(elastic, 0);
	return d;
}

Real GrainSolver::unbalanced()
{
	current();
	return onState([](const auto& state) { return flexpm::unbalanced_ratio(state); });
}

py::dict GrainSolver::balance()
{
	current();
	const auto now   = onState([](const auto& state) { return flexpm::balance(state); });
	const bool plane = grains().layout.dimension == 2;
	const auto values
	        = [&](const flexpm::SpaceTensor& t) { return plane ? py::make_tuple(t.xx, t.yy, t.xy) : py::make_tuple(t.xx, t.yy, t.zz, t.yz, t.xz, t.xy); };
	const auto force = now.missing_force;
	py::dict   d;
	d["mean_stress"]    = values(now.mean_stress);
	d["outside_stress"] = values(now.outside_stress);
	d["missing_force"]  = plane ? py::make_tuple(force.x, force.y) : py::make_tuple(force.x, force.y, force.z);
	d["plate_share"]    = now.plate_share;
	return d;
}

py::object GrainSolver::sideNodes(int side)
{
	std::vector<std::int32_t> rows;
	for (int node : flexpm::side_nodes(current(), side)) {
		const flexpm::GrainNode found = flexpm::grain_node(assembly.grains, node);
		rows.insert(rows.end(), { found.grain, found.number });
	}
	return copied(rows, 2);
}

py::dict GrainSolver::snapshot()
{
	current();
	return solid() ? snapshotOf(space) : flexpm_bindings::snapshot_dict(assembly);
}

} // namespace yade
