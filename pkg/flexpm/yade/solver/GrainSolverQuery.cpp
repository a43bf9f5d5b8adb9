// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  What Python asks of the solver: energies, counts, arrays.
#include <flexpm/yade/solver/GrainSolver.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/assembly/snapshot.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/statics/elastic_constants.hpp>

#include <algorithm>

namespace yade {

using flexpm_bindings::copied;

py::tuple GrainSolver::elasticConstants() const
{
	const auto e = flexpm::elastic_constants(assembly);
	return py::make_tuple(e.youngs_modulus, e.poissons_ratio);
}

py::dict GrainSolver::energies() const
{
	const auto e = flexpm::energies(assembly);
	py::dict   d;
	d["kinetic_energy"]   = e.kinetic;
	d["elastic_energy"]   = e.elastic;
	d["damage_energy"]    = e.damage;
	d["friction_energy"]  = e.friction;
	d["damping_energy"]   = e.damping;
	d["boundary_work"]    = e.boundary_work;
	d["potential_energy"] = e.potential;
	d["initial_energy"]   = e.initial;
	return d;
}

py::tuple GrainSolver::cracks() const
{
	const auto count = flexpm::count_cracks(assembly);
	return py::make_tuple(count.tensile, count.shear);
}

py::dict GrainSolver::counts() const
{
	int nodes = 0, triangles = 0;
	for (int g = 0; g < assembly.grains.count; ++g) {
		nodes += assembly.grains.nodes_of(g);
		triangles += flexpm::triangles_of(assembly.grains, g);
	}
	const auto bonded = flexpm::bonded_contacts(assembly);
	py::dict   d;
	d["grains"]         = *std::max_element(assembly.grains.parent.begin(), assembly.grains.parent.end()) + 1;
	d["particles"]      = assembly.grains.count;
	d["contacts"]       = bonded.between; // as in the specimen; others have touched since
	d["inner_contacts"] = bonded.within;
	d["touching"]       = assembly.contacts.count - bonded.between - bonded.within;
	d["nodes"]          = nodes;
	d["triangles"]      = triangles;
	d["groups"]         = assembly.grains.groups.size();
	d["edges"]          = assembly.edges.count;
	return d;
}

Real GrainSolver::unbalanced() const { return flexpm::unbalanced_ratio(assembly); }

py::object GrainSolver::sideNodes(int side) const
{
	std::vector<std::int32_t> rows;
	for (int node : flexpm::side_nodes(assembly, side)) {
		for (int g = 0; g < assembly.grains.count; ++g) {
			const int first = assembly.grains.node(g, 0), row = 2 * flexpm::lanes;
			if (node < first || (node - first) % row != 0 || (node - first) / row >= assembly.grains.nodes_of(g)) continue;
			rows.insert(rows.end(), { g, (node - first) / row });
		}
	}
	return copied(rows, 2);
}

py::dict GrainSolver::snapshot() const
{
	const auto s = flexpm::take_snapshot(assembly);
	const int  p = assembly.contacts.points;
	py::dict   d;
	d["positions"]         = copied(s.positions, 2);
	d["reference"]         = copied(s.reference, 2);
	d["velocities"]        = copied(s.velocities, 2);
	d["forces"]            = copied(s.forces, 2);
	d["triangles"]         = copied(s.triangles, 3);
	d["triangle_grain"]    = copied(s.triangle_grain, 0);
	d["triangle_particle"] = copied(s.triangle_particle, 0);
	d["triangle_stress"]   = copied(s.triangle_stress, 3);
	d["contact"]           = copied(s.contact, 0);
	d["contact_grains"]    = copied(s.contact_grains, 2);
	d["contact_ends"]      = copied(s.contact_ends, 2).attr("reshape")(-1, 2, 2);
	d["point_opening"]     = copied(s.point_opening, p);
	d["point_slip"]        = copied(s.point_slip, p);
	d["point_damage"]      = copied(s.point_damage, p);
	d["point_traction"]    = copied(s.point_traction, 2).attr("reshape")(-1, p, 2);
	d["crack_step"]        = copied(s.crack_step, p);
	d["crack_mode"]        = copied(s.crack_mode, p);
	d["crack_position"]    = copied(s.crack_position, 2).attr("reshape")(-1, p, 2);
	return d;
}

} // namespace yade
