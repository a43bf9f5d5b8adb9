// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Python access to cells that are sawn out of a packing, given as polygons, or read from a file.
#include <flexpm/yade/bindings/array_view.hpp>
#include <flexpm/yade/bindings/binding_discs.hpp>
#include <flexpm/yade/bindings/bindings.hpp>

#include <flexpm/kernel/tiling/given_cells.hpp>
#include <flexpm/kernel/tiling/joint_cut.hpp>
#include <flexpm/kernel/tiling/outline_cells.hpp>

#include <memory>

namespace py = boost::python;

namespace flexpm_bindings {
namespace {

	using flexpm::GivenCells;
	using flexpm::Point;
	using flexpm::PolygonOutline;
	using flexpm::Tiling;
	using Rings = std::vector<std::vector<Point>>;

	Rings rings(const py::list& arrays, const char* name)
	{
		Rings all;
		for (py::ssize_t i = 0; i < py::len(arrays); ++i)
			all.push_back(points(arrays[i], name));
		return all;
	}

	py::list arrays(const Rings& all)
	{
		py::list list;
		for (const auto& ring : all)
			list.append(dense_view(reinterpret_cast<const double*>(ring.data()), ring.size(), 2, py::object(), Access::readOnly).attr("copy")());
		return list;
	}

	/// Rows start, end, number by their edge.
	std::map<flexpm::VertexPair, int> edges(const py::object& array, const char* name)
	{
		const InputArray<int> input(array, 2, name);
		if (input.size(1) != 3)
			throw std::invalid_argument(
			        std::string(name) + " = rows of " + std::to_string(input.size(1)) + ", must be rows of 3; give start, end, number");
		std::map<flexpm::VertexPair, int> found;
		for (std::size_t i = 0; i < input.size(0); ++i)
			found[flexpm::undirected(input.data()[3 * i], input.data()[3 * i + 1])] = input.data()[3 * i + 2];
		return found;
	}

	std::shared_ptr<PolygonOutline> polygonOutline(py::object corners, py::list holes)
	{
		return std::make_shared<PolygonOutline>(PolygonOutline::make(points(corners, "corners"), rings(holes, "holes")));
	}

	py::list ringsOf(const PolygonOutline& outline) { return arrays(outline.rings()); }

	std::shared_ptr<Tiling> cellsInOutline(py::object centres, py::object radii, const PolygonOutline& outline, double shortEdge)
	{
		return std::make_shared<Tiling>(flexpm::cells_in_outline(discs(centres, radii), outline, shortEdge));
	}

	py::tuple cellsOfPolygons(py::list polygons, bool withHoles)
	{
		const GivenCells given = flexpm::cells_of_polygons(rings(polygons, "polygon"), withHoles);
		return py::make_tuple(std::make_shared<Tiling>(given.tiling), arrays(given.rings));
	}

	std::shared_ptr<Tiling>
	cellsOfFile(py::object vertices, py::list cells, py::object sides, py::object joints, py::object centres, py::object radii, py::object laguerre)
	{
		flexpm::StoredCells stored;
		stored.vertices = points(vertices, "vertices");
		for (py::ssize_t i = 0; i < py::len(cells); ++i) {
			const InputArray<int> loop(cells[i], 1, "cell");
			stored.cells.emplace_back(loop.data(), loop.data() + loop.size(0));
		}
		stored.sides  = edges(sides, "sides");
		stored.joints = edges(joints, "joints");
		stored.discs  = discs(centres, radii);
		const InputArray<int> marks(laguerre, 1, "laguerre");
		stored.laguerre.assign(marks.data(), marks.data() + marks.size(0));
		return std::make_shared<Tiling>(flexpm::cells_of_file(stored));
	}

	py::tuple cutByJoints(
	        const flexpm::Tessellation& tessellation,
	        py::object                  centres,
	        py::object                  radii,
	        py::object                  joints,
	        py::list                    lines,
	        py::object                  numbers,
	        py::object                  tell)
	{
		const InputArray<int> ofEdges(joints, 1, "joints"), ofLines(numbers, 1, "numbers");
		const Rings           places = rings(lines, "joint");
		if (places.size() != ofLines.size(0))
			throw std::invalid_argument("numbers of joints = " + std::to_string(ofLines.size(0)) + ", must be one for each line");
		std::vector<flexpm::JointLine> all;
		for (std::size_t i = 0; i < places.size(); ++i)
			all.push_back({ places[i], ofLines.data()[i] });
		const flexpm::JointCut made = flexpm::cut_by_joints(
		        tessellation, discs(centres, radii), { ofEdges.data(), ofEdges.data() + ofEdges.size(0) }, all, [&](std::size_t done) { tell(done); });
		std::vector<double> lengths;
		std::vector<int>    counts;
		for (const flexpm::LineCut& line : made.lines) {
			lengths.insert(lengths.end(), { line.length, line.cut, line.taken, line.outside });
			counts.insert(counts.end(), { line.contacts, line.on });
		}
		return py::make_tuple(std::make_shared<Tiling>(made.tiling), copied(lengths, 4), copied(counts, 2));
	}

	/// Part of the whole, which it keeps alive.
	std::shared_ptr<flexpm::Tessellation> tessellationOf(const std::shared_ptr<Tiling>& tiling)
	{
		return { &tiling->cells, [tiling](flexpm::Tessellation*) {} };
	}

	py::object discsOf(const Tiling& tiling)
	{
		std::vector<double> rows;
		for (const flexpm::Disc& d : tiling.discs)
			rows.insert(rows.end(), { d.centre.x, d.centre.y, d.radius });
		return copied(rows, 3);
	}

	py::object originOf(const Tiling& tiling) { return copied(tiling.origin, 0); }

	py::object edgeJointsOf(const Tiling& tiling) { return copied(tiling.edge_joint, 0); }

} // namespace

void register_tiling_bindings()
{
	py::class_<PolygonOutline, std::shared_ptr<PolygonOutline>>("PolygonOutline", "A simple polygon with holes.", py::no_init)
	        .def("__init__", py::make_constructor(polygonOutline, py::default_call_policies(), (py::arg("corners"), py::arg("holes"))))
	        .add_property("rings", ringsOf, "Corners, (n, 2) [m]: counter-clockwise, then of each hole, clockwise.")
	        .add_property("area", &PolygonOutline::area, "Without the holes [m^2].");
	py::class_<Tiling, std::shared_ptr<Tiling>>("Tiling", "Cells and their data.", py::no_init)
	        .add_property("tessellation", tessellationOf, "The cells.")
	        .add_property("discs", discsOf, "Rows x, y, radius [m], one per cell: reference point and radius.")
	        .add_property("origin", originOf, "Per cell: the grain that it is, or is a piece of.")
	        .add_property("edge_joints", edgeJointsOf, "Per shared edge: index of its joint, -1 without.");
	py::def("cells_in_outline",
	        cellsInOutline,
	        (py::arg("centres"), py::arg("radii"), py::arg("outline"), py::arg("short_edge")),
	        "Laguerre cells of discs, clipped to an outline, edges below short_edge [m] collapsed.");
	py::def("cells_of_polygons",
	        cellsOfPolygons,
	        (py::arg("polygons"), py::arg("with_holes")),
	        "Checked tiling of polygons, each (n, 2) [m], and the rings of its outline.");
	py::def("cut_by_joints",
	        cutByJoints,
	        (py::arg("tessellation"), py::arg("centres"), py::arg("radii"), py::arg("joints"), py::arg("lines"), py::arg("numbers"), py::arg("tell")),
	        "Cells cut by lines, each (n, 2) [m], of joints with numbers; joints has those that shared edges have already, -1 without. "
	        "tell is called with the number of finished lines. Returns also one row per line: length, cut, taken, outside [m], contacts, and the joint "
	        "that "
	        "has taken the rest.");
	py::def("cells_of_file",
	        cellsOfFile,
	        (py::arg("vertices"), py::arg("cells"), py::arg("sides"), py::arg("joints"), py::arg("centres"), py::arg("radii"), py::arg("laguerre")),
	        "Stored cells; sides and joints are rows start, end, number; laguerre as in Tessellation.");
}

} // namespace flexpm_bindings
