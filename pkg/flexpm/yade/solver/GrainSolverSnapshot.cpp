// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The state in 3D as plain arrays.
#include <flexpm/yade/solver/GrainSolver.hpp>

#include <flexpm/kernel/view/snapshot.hpp>

#include <algorithm>
#include <memory>

namespace yade {

using flexpm_bindings::copied;

namespace {

	/// numpy array that takes the values over: of a large solid a copy of all is gigabytes.
	template <class T> py::object given(std::vector<T>& values, int columns)
	{
		auto             kept = std::make_unique<std::vector<T>>(std::move(values));
		const auto       drop = [](PyObject* of) { delete static_cast<std::vector<T>*>(PyCapsule_GetPointer(of, nullptr)); };
		const py::object owner { py::handle<>(PyCapsule_New(kept.get(), nullptr, drop)) };
		const auto&      own = *kept.release();
		return flexpm_bindings::dense_view(own.data(), own.size() / std::max(columns, 1), columns, owner, flexpm_bindings::Access::readWrite);
	}

} // namespace

py::dict GrainSolver::snapshotOf(const flexpm::SolidState& state)
{
	auto     s = flexpm::take_snapshot(state);
	py::dict d;
	d["positions"]          = given(s.positions, 3);
	d["reference"]          = given(s.reference, 3);
	d["velocities"]         = given(s.velocities, 3);
	d["forces"]             = given(s.forces, 3);
	d["node_offsets"]       = given(s.node_offsets, 0);
	d["centres"]            = given(s.centres, 3);
	d["volumes"]            = given(s.volumes, 0);
	d["tetrahedra"]         = given(s.elements, 4);
	d["tetrahedron_grain"]  = given(s.element_grain, 0);
	d["tetrahedron_stress"] = given(s.element_stress, 6);
	d["surface"]            = given(s.surface, 3);
	d["surface_grain"]      = given(s.surface_grain, 0);
	d["surface_side"]       = given(s.surface_side, 0);
	d["contact_grains"]     = given(s.contact_grains, 2);
	d["corner_offsets"]     = given(s.corner_offsets, 0);
	d["corner_nodes"]       = given(s.corner_nodes, 2);
	d["corners"]            = given(s.corners, 3);
	d["areas"]              = given(s.areas, 0);
	d["point_offsets"]      = given(s.point_offsets, 0);
	d["point_area"]         = given(s.point_area, 0);
	d["point_position"]     = given(s.point_position, 3);
	d["point_opening"]      = given(s.point_opening, 0);
	d["point_slip"]         = given(s.point_slip, 2);
	d["point_damage"]       = given(s.point_damage, 0);
	d["point_traction"]     = given(s.point_traction, 3);
	d["crack_step"]         = copied(std::vector<double>(s.crack_step.begin(), s.crack_step.end()), 0).attr("astype")("int64");
	d["crack_mode"]         = given(s.crack_mode, 0);
	d["crack_position"]     = given(s.crack_position, 3);
	d["crack_energy"]       = given(s.crack_energy, 0);
	return d;
}

} // namespace yade
