// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Python access to the cells of inner particles, paper Sec. 4.1.
#include <flexpm/yade/bindings/array_view.hpp>
#include <flexpm/yade/bindings/bindings.hpp>

#include <flexpm/kernel/geometry/subdivision.hpp>

#include <memory>

namespace py = boost::python;

namespace flexpm_bindings {
namespace {

	using flexpm::InnerCells;

	/// Part of the whole, which it keeps alive. Boost.Python would turn a pointer that shares the whole's own count into the whole.
	std::shared_ptr<flexpm::Tessellation> innerTessellation(const std::shared_ptr<InnerCells>& inner)
	{
		return { &inner->cells, [inner](flexpm::Tessellation*) {} };
	}

	py::object innerDiscs(const InnerCells& inner)
	{
		std::vector<double> rows;
		for (const flexpm::Disc& d : inner.discs)
			rows.insert(rows.end(), { d.centre.x, d.centre.y, d.radius });
		return copied(rows, 3);
	}

	py::object grain(const InnerCells& inner) { return copied(inner.grain, 0); }

	py::object outer(const InnerCells& inner) { return copied(std::vector<int>(inner.outer.begin(), inner.outer.end()), 0); }

	std::shared_ptr<InnerCells> innerCells(const flexpm::Tessellation& grains, double meanCount)
	{
		return std::make_shared<InnerCells>(flexpm::make_inner_cells(grains, meanCount));
	}

} // namespace

void register_subdivision_bindings()
{
	py::class_<InnerCells, std::shared_ptr<InnerCells>>("InnerCells", "Cells of the inner particles of all grains.", py::no_init)
	        .add_property("tessellation", innerTessellation, "The cells as one tessellation; a stretch that two share is a shared edge.")
	        .add_property("discs", innerDiscs, "Rows x, y, radius [m] of the particles, one per cell.")
	        .add_property("grain", grain, "Grain of each cell.")
	        .add_property("outer", outer, "Per shared edge: 1 between two grains, 0 within one.");
	py::def("inner_cells",
	        innerCells,
	        (py::arg("tessellation"), py::arg("mean_count") = flexpm::inner_particles),
	        "Cut grains into cells of about equal area.");
}

} // namespace flexpm_bindings
