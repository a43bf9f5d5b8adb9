// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Python access to the geometry of a specimen: radii, insertion, tessellation, grain meshes (paper Sec. 3.1).
#include <flexpm/yade/bindings/array_view.hpp>
#include <flexpm/yade/bindings/assembly_input.hpp>
#include <flexpm/yade/bindings/binding_discs.hpp>
#include <flexpm/yade/bindings/bindings.hpp>

#include <flexpm/kernel/fem/grain_mesh.hpp>
#include <flexpm/kernel/geometry/disc_sizes.hpp>
#include <flexpm/kernel/geometry/insertion.hpp>
#include <flexpm/kernel/geometry/tessellation.hpp>

#include <memory>

namespace py = boost::python;

namespace flexpm_bindings {
namespace {

	static_assert(sizeof(flexpm::Point) == 2 * sizeof(double), "points are viewed as rows of two doubles");
	static_assert(sizeof(flexpm::SharedEdge) == 4 * sizeof(int), "edges are viewed as rows of four integers");
	static_assert(sizeof(flexpm::BoundaryEdge) == 4 * sizeof(int), "edges are viewed as rows of four integers");

	/// Meshes of all grains, end to end, so that numpy can view them.
	struct GrainMeshes {
		std::vector<flexpm::Point>    nodes;
		std::vector<flexpm::Triangle> triangles;
		std::vector<int>              nodeOffsets { 0 }, triangleOffsets { 0 }, firstVertex;
		std::vector<std::uint8_t>     standard, fallback, movedCentre;
		std::vector<double>           smallestAngle;

		void add(const flexpm::GrainMesh& mesh)
		{
			nodes.insert(nodes.end(), mesh.nodes.begin(), mesh.nodes.end());
			triangles.insert(triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
			nodeOffsets.push_back(static_cast<int>(nodes.size()));
			triangleOffsets.push_back(static_cast<int>(triangles.size()));
			firstVertex.push_back(mesh.first_vertex);
			standard.push_back(mesh.standard);
			fallback.push_back(mesh.fallback);
			movedCentre.push_back(mesh.moved_centre);
			smallestAngle.push_back(mesh.smallest_angle);
		}
	};

	using flexpm::Tessellation;
	template <class T, class Item, std::vector<Item> GrainMeshes::*member> constexpr auto meshRows = rows<T, GrainMeshes, Item, member>;

	std::vector<double> numbers(const py::object& array, const char* name)
	{
		const InputArray<double> input(array, 1, name);
		return { input.data(), input.data() + input.size(0) };
	}

} // namespace

std::vector<flexpm::Point> points(const py::object& array, const char* name)
{
	const InputArray<double> input(array, 2, name);
	if (input.size(1) != 2)
		throw std::invalid_argument(std::string(name) + " = rows of " + std::to_string(input.size(1)) + ", must be rows of 2; give x and y");
	const auto* first = reinterpret_cast<const flexpm::Point*>(input.data());
	return { first, first + input.size(0) };
}

std::vector<flexpm::Disc> discs(const py::object& centres, const py::object& radii)
{
	const auto c = points(centres, "centres");
	const auto r = numbers(radii, "radii");
	if (c.size() != r.size())
		throw std::invalid_argument(
		        "radii = " + std::to_string(r.size()) + " values, must be one per centre, " + std::to_string(c.size()) + "; complete them");
	std::vector<flexpm::Disc> result;
	for (std::size_t i = 0; i < c.size(); ++i)
		result.push_back({ c[i], r[i] });
	return result;
}

namespace {

	flexpm::Outline polygon(py::object corners) { return flexpm::Outline::polygon(points(corners, "corners")); }

	flexpm::Outline circle(double x, double y, double radius) { return flexpm::Outline::circle({ x, y }, radius); }

	bool containsPoint(const flexpm::Outline& outline, double x, double y) { return flexpm::contains(outline, { x, y }); }

	py::object discRadii(int count, double dMin, double dMax, std::uint64_t seed)
	{
		const auto radii = flexpm::disc_radii(count, dMin, dMax, seed);
		return copied(radii, 0);
	}

	py::object insertDiscs(py::object radii, const flexpm::Outline& outline, double shrink, std::uint64_t seed)
	{
		const auto centres = flexpm::insert_discs(numbers(radii, "radii"), outline, shrink, seed);
		return dense_view(reinterpret_cast<const double*>(centres.data()), centres.size(), 2, py::object(), Access::readOnly).attr("copy")();
	}

	std::shared_ptr<Tessellation> tessellate(py::object centres, py::object radii, const flexpm::Outline& outline, double shortEdge, bool allowHidden)
	{
		return std::make_shared<Tessellation>(flexpm::tessellate(discs(centres, radii), outline, { shortEdge, allowHidden }));
	}

	py::object cellAreas(const Tessellation& tessellation)
	{
		std::vector<double> areas;
		for (int cell = 0; cell < tessellation.cells(); ++cell)
			areas.push_back(flexpm::cell_area(tessellation, cell));
		return copied(areas, 0, Access::readOnly);
	}

	py::object laguerreOf(const Tessellation& tessellation)
	{
		std::vector<int> marks;
		for (int cell = 0; cell < tessellation.cells(); ++cell)
			marks.push_back(tessellation.is_laguerre(cell));
		return copied(marks, 0);
	}

	std::shared_ptr<GrainMeshes> grainMeshes(const Tessellation& tessellation, py::object centres, py::object radii, const std::string& kind)
	{
		auto result = std::make_shared<GrainMeshes>();
		for (const auto& mesh : flexpm::make_grain_meshes(tessellation, discs(centres, radii), meshKind("grain_meshes: mesh", kind)))
			result->add(mesh);
		return result;
	}

	void registerTessellation()
	{
		using T = Tessellation;
		py::class_<T, std::shared_ptr<T>>("Tessellation", "Laguerre cells over common vertices. Arrays are read-only views.", py::no_init)
		        .add_property("cells", &T::cells, "Number of cells.")
		        .add_property("vertices", rows<double, T, flexpm::Point, &T::vertices>, "Vertices, (n, 2) [m].")
		        .add_property("cell_offsets", integers<T, int, &T::cell_offsets>, "Cell i owns cell_vertices[cell_offsets[i]:cell_offsets[i + 1]].")
		        .add_property("cell_vertices", integers<T, int, &T::cell_vertices>, "Vertex indices, counter-clockwise, cell after cell.")
		        .add_property("disc_of_cell", integers<T, int, &T::disc_of_cell>, "Disc of each cell.")
		        .add_property(
		                "laguerre",
		                laguerreOf,
		                "Per cell: 1 for the whole Laguerre cell of its disc, 0 for a user-supplied, cut or split cell (a copy).")
		        .add_property(
		                "shared_edges", integers<T, flexpm::SharedEdge, &T::shared_edges>, "Rows cell_a < cell_b, start, end; cell_a on the left.")
		        .add_property("boundary_edges", integers<T, flexpm::BoundaryEdge, &T::boundary_edges>, "Rows cell, start, end, side of the outline.")
		        .add_property("merged_vertices", integers<T, int, &T::merged_vertices>, "Vertices into which short edges were collapsed.")
		        .add_property("hidden_discs", integers<T, int, &T::hidden_discs>, "Discs without a cell.")
		        .add_property("cell_areas", cellAreas, "Area of each cell [m^2] (a copy).")
		        .def_readonly("uncollapsed_shared_edges", &T::uncollapsed_shared_edges, "Shared edges before short edges were collapsed.");
	}

	void registerMeshes()
	{
		using M = GrainMeshes;
		py::class_<M, std::shared_ptr<M>>("GrainMeshes", "Meshes of all grains, end to end. Arrays are read-only views.", py::no_init)
		        .add_property("nodes", meshRows<double, flexpm::Point, &M::nodes>, "Node positions, (n, 2) [m].")
		        .add_property("triangles", meshRows<int, flexpm::Triangle, &M::triangles>, "Node indices within the grain, (m, 3), counter-clockwise.")
		        .add_property("node_offsets", meshRows<int, int, &M::nodeOffsets>, "Grain i owns nodes[node_offsets[i]:node_offsets[i + 1]].")
		        .add_property("triangle_offsets", meshRows<int, int, &M::triangleOffsets>, "Grain i owns triangles[triangle_offsets[i]:...].")
		        .add_property("first_vertex", meshRows<int, int, &M::firstVertex>, "Corner of the cell on which node 0 of the grain lies.")
		        .add_property("standard", meshRows<std::uint8_t, std::uint8_t, &M::standard>, "1: connectivity of the template.")
		        .add_property("fallback", meshRows<std::uint8_t, std::uint8_t, &M::fallback>, "1: fan, although refined was requested.")
		        .add_property(
		                "moved_centre",
		                meshRows<std::uint8_t, std::uint8_t, &M::movedCentre>,
		                "1: centroid, as the disc centre does not see every edge.")
		        .add_property("smallest_angle", meshRows<double, double, &M::smallestAngle>, "Smallest angle of each grain's triangles [rad].");
	}

} // namespace

void register_geometry_bindings()
{
	py::class_<flexpm::Outline>("Outline", "Convex polygon or circle that the cells fill.", py::no_init)
	        .def("polygon", polygon, py::arg("corners"), "Counter-clockwise, strictly convex corners, (n, 2) [m].")
	        .staticmethod("polygon")
	        .def("circle", circle, (py::arg("x"), py::arg("y"), py::arg("radius")), "Circle [m]; its arcs become chords.")
	        .staticmethod("circle")
	        .def("contains", containsPoint, (py::arg("x"), py::arg("y")), "True inside and on the outline.");
	registerTessellation();
	registerMeshes();
	py::def("disc_count",
	        flexpm::disc_count,
	        (py::arg("area"), py::arg("d_min"), py::arg("d_max"), py::arg("porosity")),
	        "Number of discs A (1 - n) / (pi R^2), rounded.");
	py::def("disc_radii",
	        discRadii,
	        (py::arg("count"), py::arg("d_min"), py::arg("d_max"), py::arg("seed")),
	        "Radii [m], diameters uniform in [d_min, d_max).");
	py::def("insert_discs",
	        insertDiscs,
	        (py::arg("radii"), py::arg("outline"), py::arg("shrink"), py::arg("seed")),
	        "Random centres (n, 2) [m] of discs that do not overlap at `shrink` times their radii.");
	py::def("tessellate",
	        tessellate,
	        (py::arg("centres"), py::arg("radii"), py::arg("outline"), py::arg("short_edge"), py::arg("allow_hidden")),
	        "Laguerre cells, edges below short_edge [m] collapsed.");
	py::def("grain_meshes",
	        grainMeshes,
	        (py::arg("tessellation"), py::arg("centres"), py::arg("radii"), py::arg("kind")),
	        "Meshes of all grains; kind is fan or refined.");
}

} // namespace flexpm_bindings
