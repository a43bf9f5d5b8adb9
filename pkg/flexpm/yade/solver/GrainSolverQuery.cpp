// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  What Python asks of the solver: energies, counts, arrays.
#include <flexpm/yade/solver/GrainSolver.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/laboratory/test_frame.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/measure/grain_parting.hpp>
#include <flexpm/kernel/measure/mean_stress.hpp>
#include <flexpm/kernel/measure/overlaps.hpp>
#include <flexpm/kernel/statics/elastic_constants.hpp>
#include <flexpm/kernel/view/snapshot.hpp>

#include <algorithm>

namespace yade {

using flexpm_bindings::copied;

py::tuple GrainSolver::elasticConstants()
{
	const auto e = flexpm::elastic_constants(current());
	return py::make_tuple(e.youngs_modulus, e.poissons_ratio);
}

Real GrainSolver::crossingSteps(Real diameter) { return flexpm::disc_scales(assembly, diameter, Omega::instance().getScene()->dt).crossing_steps; }

py::dict GrainSolver::energies()
{
	const auto e = flexpm::energies(current());
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
	const auto count = flexpm::count_cracks(current());
	return py::make_tuple(count.tensile, count.shear);
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

py::dict GrainSolver::counts()
{
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

Real GrainSolver::unbalanced() { return flexpm::unbalanced_ratio(current()); }

py::dict GrainSolver::balance()
{
	const auto now    = flexpm::balance(current());
	const auto values = [](const flexpm::Tensor& t) { return py::make_tuple(t.xx, t.yy, t.xy); };
	py::dict   d;
	d["mean_stress"]    = values(now.mean_stress);
	d["outside_stress"] = values(now.outside_stress);
	d["missing_force"]  = py::make_tuple(now.missing_force.x, now.missing_force.y);
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
	const auto s = flexpm::take_snapshot(current());
	const int  p = assembly.contacts.group.points; // all contacts have as many: rows of (contact, point)
	py::dict   d;
	d["positions"]           = copied(s.positions, 2);
	d["reference"]           = copied(s.reference, 2);
	d["velocities"]          = copied(s.velocities, 2);
	d["forces"]              = copied(s.forces, 2);
	d["triangles"]           = copied(s.triangles, 3);
	d["triangle_grain"]      = copied(s.triangle_grain, 0);
	d["triangle_particle"]   = copied(s.triangle_particle, 0);
	d["triangle_stress"]     = copied(s.triangle_stress, 3);
	d["contact"]             = copied(s.contact, 0);
	d["contact_grains"]      = copied(s.contact_grains, 2);
	d["contact_ends"]        = copied(s.contact_ends, 2).attr("reshape")(-1, 2, 2);
	d["point_opening"]       = copied(s.point_opening, p);
	d["point_slip"]          = copied(s.point_slip, p);
	d["point_damage"]        = copied(s.point_damage, p);
	d["point_traction"]      = copied(s.point_traction, 2).attr("reshape")(-1, p, 2);
	d["crack_step"]          = copied(s.crack_step, p);
	d["crack_mode"]          = copied(s.crack_mode, p);
	d["crack_position"]      = copied(s.crack_position, 2).attr("reshape")(-1, p, 2);
	d["crack_energy"]        = copied(s.crack_energy, p);
	d["erased_contact"]      = copied(s.erased_contact, 0);
	d["erased_grains"]       = copied(s.erased_grains, 2);
	d["erased_ends"]         = copied(s.erased_ends, 2).attr("reshape")(-1, 2, 2);
	d["erased_crack_step"]   = copied(s.erased_crack_step, p);
	d["erased_crack_mode"]   = copied(s.erased_crack_mode, p);
	d["erased_crack_energy"] = copied(s.erased_crack_energy, p);

	d["erased_crack_position"] = copied(s.erased_crack_position, 2).attr("reshape")(-1, p, 2);
	return d;
}

} // namespace yade
