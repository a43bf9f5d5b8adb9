// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The kernel's snapshot for Python.
#pragma once

#include <flexpm/kernel/view/snapshot.hpp>
#include <flexpm/yade/bindings/array_view.hpp>

namespace flexpm_bindings {

/// The state as plain arrays, by name (see the documentation's list of arrays).
inline boost::python::dict snapshot_dict(const flexpm::Assembly& assembly)
{
	const auto          s = flexpm::take_snapshot(assembly);
	boost::python::dict d;
	d["positions"]             = copied(s.positions, 2);
	d["reference"]             = copied(s.reference, 2);
	d["velocities"]            = copied(s.velocities, 2);
	d["forces"]                = copied(s.forces, 2);
	d["triangles"]             = copied(s.elements, 3);
	d["triangle_grain"]        = copied(s.element_grain, 0);
	d["triangle_particle"]     = copied(s.element_particle, 0);
	d["triangle_stress"]       = copied(s.element_stress, 3);
	d["contact"]               = copied(s.contact, 0);
	d["contact_grains"]        = copied(s.contact_grains, 2);
	d["contact_ends"]          = copied(s.contact_ends, 2).attr("reshape")(-1, 2, 2);
	d["point_contact"]         = copied(s.point_contact, 0);
	d["point_share"]           = copied(s.point_share, 0);
	d["point_opening"]         = copied(s.point_opening, 0);
	d["point_slip"]            = copied(s.point_slip, 0);
	d["point_damage"]          = copied(s.point_damage, 0);
	d["point_traction"]        = copied(s.point_traction, 2);
	d["crack_step"]            = copied(std::vector<std::int32_t>(s.crack_step.begin(), s.crack_step.end()), 0);
	d["crack_mode"]            = copied(s.crack_mode, 0);
	d["crack_position"]        = copied(s.crack_position, 2);
	d["crack_energy"]          = copied(s.crack_energy, 0);
	d["erased_contact"]        = copied(s.erased_contact, 0);
	d["erased_grains"]         = copied(s.erased_grains, 2);
	d["erased_ends"]           = copied(s.erased_ends, 2).attr("reshape")(-1, 2, 2);
	d["erased_point_bond"]     = copied(s.erased_point_bond, 0);
	d["erased_crack_step"]     = copied(std::vector<std::int32_t>(s.erased.crack_step.begin(), s.erased.crack_step.end()), 0);
	d["erased_crack_mode"]     = copied(s.erased.crack_mode, 0);
	d["erased_crack_energy"]   = copied(s.erased.crack_energy, 0);
	d["erased_crack_position"] = copied(s.erased.crack_position, 2);
	return d;
}

} // namespace flexpm_bindings
