// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Python access to the geometry of solids: insertion of spheres, polyhedral cells, their tetrahedra.
#include <flexpm/yade/bindings/array_view.hpp>
#include <flexpm/yade/bindings/bindings.hpp>

#include <flexpm/kernel/space/face_points.hpp>
#include <flexpm/kernel/space/fan_meshes.hpp>
#include <flexpm/kernel/space/own_polyhedra.hpp>
#include <flexpm/kernel/space/sphere_insertion.hpp>
#include <flexpm/kernel/space/sphere_sizes.hpp>
#include <flexpm/kernel/statics/solid_constants.hpp>

#include <array>
#include <memory>

namespace py = boost::python;

namespace flexpm_bindings {
namespace {

	using flexpm::FanMeshes;
	using flexpm::Polyhedra;
	using flexpm::Solid;

	static_assert(sizeof(flexpm::Vector) == 3 * sizeof(double), "vectors are viewed as rows of three doubles");
	static_assert(sizeof(flexpm::PolyhedronFace) == 3 * sizeof(int), "faces are viewed as rows of three integers");

	template <std::vector<flexpm::Vector> Polyhedra::*member> constexpr auto vectors = rows<double, Polyhedra, flexpm::Vector, member>;

	std::vector<flexpm::Sphere> spheres(const py::object& array)
	{
		const InputArray<double> input(array, 2, "spheres");
		if (input.size(1) != 4)
			throw std::invalid_argument("spheres = rows of " + std::to_string(input.size(1)) + ", must be rows of 4; give x, y, z and radius");
		std::vector<flexpm::Sphere> result;
		for (std::size_t i = 0; i < input.size(0); ++i) {
			const double* row = input.data() + 4 * i;
			result.push_back({ { row[0], row[1], row[2] }, row[3] });
		}
		return result;
	}

	py::object walls(const Solid& solid)
	{
		std::vector<double> values;
		for (const auto& wall : solid.walls)
			for (double value : { wall.normal.x, wall.normal.y, wall.normal.z, wall.offset })
				values.push_back(value);
		return copied(values, 4, Access::readOnly);
	}

	py::object sides(const Solid& solid)
	{
		std::vector<int> values;
		for (const auto& wall : solid.walls)
			values.push_back(static_cast<int>(wall.side));
		return copied(values, 0, Access::readOnly);
	}

	py::object insertSpheres(py::object radii, const Solid& solid, double shrink, std::uint64_t seed)
	{
		const InputArray<double> input(radii, 1, "radii");
		const auto               centres = flexpm::insert_spheres({ input.data(), input.data() + input.size(0) }, solid, shrink, seed);
		return dense_view(reinterpret_cast<const double*>(centres.data()), centres.size(), 3, py::object(), Access::readOnly).attr("copy")();
	}

	std::vector<flexpm::Vector> places(const py::object& array, const char* name)
	{
		const InputArray<double> input(array, 2, name);
		if (input.size(0) > 0 && input.size(1) != 3)
			throw std::invalid_argument(std::string(name) + " = rows of " + std::to_string(input.size(1)) + ", must be rows of 3; give x, y and z");
		std::vector<flexpm::Vector> result;
		for (std::size_t i = 0; i < input.size(0); ++i)
			result.push_back({ input.data()[3 * i], input.data()[3 * i + 1], input.data()[3 * i + 2] });
		return result;
	}

	flexpm::JointPlane jointPlane(const py::object& normal, double offset, const py::object& corners)
	{
		const auto component = [&](int i) { return double(py::extract<double>(normal[i])); };
		return { { component(0), component(1), component(2) }, offset, places(corners, "corners") };
	}

	/// Planes of joints: normal, offset, and corners of a polygon, none for a whole plane.
	std::vector<flexpm::JointPlane> jointPlanes(const py::list& joints)
	{
		std::vector<flexpm::JointPlane> result;
		for (py::ssize_t i = 0; i < py::len(joints); ++i)
			result.push_back(jointPlane(joints[i][0], py::extract<double>(joints[i][1]), joints[i][2]));
		return result;
	}

	/// Holes: of each one its facets, as planes of joints.
	std::vector<flexpm::Hole> holesOf(const py::list& holes)
	{
		std::vector<flexpm::Hole> result;
		for (py::ssize_t i = 0; i < py::len(holes); ++i)
			result.push_back(jointPlanes(py::list(holes[i])));
		return result;
	}

	double areaWithin(py::object normal, double offset, py::object corners, const Solid& solid)
	{
		return flexpm::area_within(jointPlane(normal, offset, corners), solid);
	}

	py::object jointCuts(const Polyhedra& cells)
	{
		std::vector<double> values;
		for (const auto& cut : cells.joint_cuts)
			for (double value :
			     { cut.within, cut.areas.cut, cut.areas.taken, cut.areas.bridged, cut.areas.beyond, cut.areas.detour, cut.areas.bend })
				values.push_back(value);
		return copied(values, 7, Access::readOnly);
	}

	py::object holeCuts(const Polyhedra& cells)
	{
		std::vector<double> values;
		for (const auto& cut : cells.hole_cuts)
			for (double value : { cut.within, cut.removed })
				values.push_back(value);
		return copied(values, 2, Access::readOnly);
	}

	std::shared_ptr<Polyhedra>
	polyhedra(py::object rows, const Solid& solid, double shortEdge, bool allowHidden, py::list notches, py::list joints, py::list holes)
	{
		flexpm::PolyhedraOptions options { shortEdge, allowHidden };
		options.joints = jointPlanes(joints);
		options.holes  = holesOf(holes);
		for (py::ssize_t i = 0; i < py::len(notches); ++i)
			options.notches.push_back({ py::extract<double>(notches[i][0]), py::extract<double>(notches[i][1]), py::extract<bool>(notches[i][2]) });
		return std::make_shared<Polyhedra>(flexpm::polyhedra(spheres(rows), solid, options));
	}

	/// Given cells: vertices, rows first, second of faces, their offsets among the corners, and spheres.
	std::shared_ptr<Polyhedra> ownPolyhedra(
	        py::object vertices, py::tuple faces, py::object rows, const Solid& solid, double shortEdge, py::object pores, py::list joints, py::list holes)
	{
		const InputArray<int> pairs(faces[0], 2, "pairs"), offsets(faces[1], 1, "offsets"), corners(faces[2], 1, "corners");
		if (pairs.size(1) != 2 || offsets.size(0) != pairs.size(0) + 1)
			throw std::invalid_argument("pairs, offsets = of other sizes, must be rows of 2, and one offset more than pairs");
		flexpm::OwnCells own;
		own.spheres = spheres(rows);
		const InputArray<int> taken(pores, 1, "pores");
		own.pores.assign(taken.data(), taken.data() + taken.size(0));
		own.vertices = places(vertices, "vertices");
		own.joints   = jointPlanes(joints);
		own.holes    = holesOf(holes);
		for (std::size_t f = 0; f < pairs.size(0); ++f) {
			const int first = offsets.data()[f], end = offsets.data()[f + 1];
			if (first < 0 || end < first || static_cast<std::size_t>(end) > corners.size(0))
				throw std::invalid_argument("offsets = " + std::to_string(end) + ", must rise from 0 to the number of corners");
			own.faces.push_back({ pairs.data()[2 * f], pairs.data()[2 * f + 1], { corners.data() + first, corners.data() + end } });
		}
		return std::make_shared<Polyhedra>(flexpm::own_polyhedra(own, solid, shortEdge));
	}

	std::shared_ptr<FanMeshes> fanMeshes(const Polyhedra& cells) { return std::make_shared<FanMeshes>(flexpm::fan_meshes(cells)); }

	/// Offsets and elements as numpy knows them.
	template <std::vector<std::int64_t> FanMeshes::*member> py::object offsets(const FanMeshes& meshes)
	{
		const auto& values = meshes.*member;
		return copied(std::vector<double>(values.begin(), values.end()), 0).attr("astype")("int64");
	}

	/// Points of all contacts by the rule of the model, and how many contacts could not have it.
	py::tuple facePointCounts(const Polyhedra& cells)
	{
		int points = 0, fallbacks = 0;
		for (int face = 0; face < cells.contacts; ++face) {
			std::vector<flexpm::Vector> corners;
			for (int vertex : cells.corners(face))
				corners.push_back(cells.vertices[vertex]);
			const auto found = flexpm::face_points(corners, flexpm::FacePointRule::corners_and_inner);
			points += static_cast<int>(found.points.size());
			fallbacks += found.fallback;
		}
		return py::make_tuple(points, fallbacks);
	}

	py::tuple solidConstants(const Polyhedra& cells, const Solid& solid, py::object laws, py::object kinds)
	{
		const InputArray<double> rows(laws, 2, "laws");
		if (rows.size(1) != 4)
			throw std::invalid_argument(
			        "laws = rows of " + std::to_string(rows.size(1))
			        + ", must be rows of 4; give young, poisson, normal_stiffness and shear_ratio");
		std::vector<flexpm::SolidElasticity> pairs;
		for (std::size_t i = 0; i < rows.size(0); ++i) {
			const double* row = rows.data() + 4 * i;
			pairs.push_back({ row[0], row[1], row[2], row[3] });
		}
		const InputArray<int> kind(kinds, 1, "kinds");
		const auto            found = flexpm::solid_constants(cells, solid, { pairs, { kind.data(), kind.data() + kind.size(0) } });
		return py::make_tuple(found.youngs_modulus, found.poissons_ratio, found.iterations, found.residual);
	}

	void registerPolyhedra()
	{
		using P = Polyhedra;
		py::class_<P, std::shared_ptr<P>>("Polyhedra", "Polyhedral cells over common vertices. Arrays are read-only views.", py::no_init)
		        .add_property("cells", &P::cells, "Number of cells.")
		        .add_property("vertices", vectors<&P::vertices>, "Vertices, (n, 3) [m].")
		        .add_property("centres", vectors<&P::centres>, "Common corner of the tetrahedra of each cell, (n, 3) [m].")
		        .add_property("volumes", rows<double, P, double, &P::volumes>, "Volume of each cell [m^3].")
		        .add_property(
		                "faces",
		                integers<P, flexpm::PolyhedronFace, &P::faces>,
		                "Rows cell_a < cell_b, -1; on a wall cell, -1, wall. Contacts come first.")
		        .add_property("face_offsets", integers<P, int, &P::face_offsets>, "Face i owns face_vertices[face_offsets[i]:face_offsets[i + 1]].")
		        .add_property(
		                "face_vertices", integers<P, int, &P::face_vertices>, "Vertex indices, counter-clockwise from outside cell_a, face after face.")
		        .add_property("joints", integers<P, int, &P::joints>, "Index of the joint plane that each contact lies on, -1: none.")
		        .add_property(
		                "joint_cuts",
		                jointCuts,
		                "Areas of each joint plane, as seen along its normal [m^2]: within the solid, cut, taken by earlier planes, bridged by whole "
		                "cells, and "
		                "cut beyond the polygon; the true area of faces off the plane [m^2]; the largest distance of their corners from it [m].")
		        .add_property("hole_cuts", holeCuts, "Volume of each hole inside the cells, and of the cells that it has taken out [m^3].")
		        .def_readonly("first_hole", &P::first_hole, "Wall index of the first hole; other holes follow.")
		        .add_property("sphere_of_cell", integers<P, int, &P::sphere_of_cell>, "Sphere of each cell.")
		        .add_property("hidden_spheres", integers<P, int, &P::hidden_spheres>, "Spheres without a cell.")
		        .add_property("moved_centres", integers<P, int, &P::moved_centres>, "Cells whose centre is their centroid.")
		        .def_readonly("contacts", &P::contacts, "Number of faces between cells.")
		        .def_readonly("uncollapsed_contacts", &P::uncollapsed_contacts, "Contacts before short edges were collapsed.")
		        .def_readonly("short_edges", &P::short_edges, "Edges below the limit that could not be removed.");
	}

} // namespace

void register_space_bindings()
{
	py::class_<Solid>("Solid", "Convex outline in 3D.", py::no_init)
	        .def("box", Solid::box, (py::arg("width"), py::arg("depth"), py::arg("height")), "Box from the origin.")
	        .staticmethod("box")
	        .def("cylinder", Solid::cylinder, (py::arg("diameter"), py::arg("height"), py::arg("grain")), "Upright prism about the z axis, from z = 0.")
	        .staticmethod("cylinder")
	        .def("disc",
	             Solid::disc,
	             (py::arg("diameter"), py::arg("depth"), py::arg("grain")),
	             "Prism about the y axis, from y = 0, with a facet below and one on top.")
	        .staticmethod("disc")
	        .def("half_disc",
	             Solid::half_disc,
	             (py::arg("diameter"), py::arg("depth"), py::arg("grain")),
	             "Upper half of a prism about the y axis, from y = 0, flat below at z = 0, with a facet on top.")
	        .staticmethod("half_disc")
	        .add_property("walls", walls, "Rows nx, ny, nz, offset: outside where n . p > offset.")
	        .add_property("sides", sides, "Side of each wall: 0 bottom, 1 right or lateral surface, 2 top, 3 left, 4 front, 5 back.")
	        .def_readonly("volume", &Solid::volume, "[m^3]");
	registerPolyhedra();
	using M = FanMeshes;
	py::class_<M, std::shared_ptr<M>>("FanMeshes", "Tetrahedra of all grains, end to end.", py::no_init)
	        .add_property("node_offsets", offsets<&M::node_offsets>, "Grain i owns nodes node_offsets[i]:node_offsets[i + 1] (a copy).")
	        .add_property("node_vertices", rows<int, M, int, &M::node_vertices>, "Vertex of the cells at each node, -1: centre of the grain.")
	        .add_property("element_offsets", offsets<&M::element_offsets>, "Grain i owns elements element_offsets[i]:element_offsets[i + 1] (a copy).")
	        .add_property("elements", rows<int, M, std::array<int, 4>, &M::elements>, "Nodes of each tetrahedron, from 0 in its grain.")
	        .add_property("volumes", rows<double, M, double, &M::volumes>, "Volume of each tetrahedron [m^3].");
	py::def("sphere_count",
	        flexpm::sphere_count,
	        (py::arg("volume"), py::arg("d_min"), py::arg("d_max"), py::arg("porosity")),
	        "Number of spheres from their mean volume.");
	py::def("insert_spheres",
	        insertSpheres,
	        (py::arg("radii"), py::arg("solid"), py::arg("shrink"), py::arg("seed")),
	        "Random centres without overlap, (n, 3) [m].");
	py::def("polyhedra",
	        polyhedra,
	        (py::arg("spheres"),
	         py::arg("solid"),
	         py::arg("short_edge"),
	         py::arg("allow_hidden"),
	         py::arg("notches") = py::list(),
	         py::arg("joints")  = py::list(),
	         py::arg("holes")   = py::list()),
	        "Return the Laguerre cells of spheres, rows x, y, z, radius. notches: x and z of the front of each notch, and whether it comes from above; the "
	        "flanks of notch i have the wall index walls + i. joints: normal, offset and corners (n, 3) of each joint plane, no corners: the whole plane; "
	        "they "
	        "are cut in their order. holes: of each hole a list of its facets, as joints, with normals out of the hole.");
	py::def("area_within",
	        areaWithin,
	        (py::arg("normal"), py::arg("offset"), py::arg("corners"), py::arg("solid")),
	        "Return the area of a joint plane inside a solid [m^2].");
	py::def("own_polyhedra",
	        ownPolyhedra,
	        (py::arg("vertices"),
	         py::arg("faces"),
	         py::arg("spheres"),
	         py::arg("solid"),
	         py::arg("short_edge"),
	         py::arg("pores"),
	         py::arg("joints") = py::list(),
	         py::arg("holes")  = py::list()),
	        "Return user-supplied convex cells. faces: pairs of cells, offsets of the faces in the list of corners, and this list; spheres: rows x, y, z, "
	        "radius of the cells; pores: cells that are taken out after short edges are collapsed, in order; joints, holes: as for polyhedra.");
	py::def("fan_meshes", fanMeshes, py::arg("cells"), "Tetrahedra of all cells.");
	py::def("solid_constants",
	        solidConstants,
	        (py::arg("cells"), py::arg("solid"), py::arg("laws"), py::arg("kinds")),
	        "Return Young's modulus [Pa], Poisson's ratio, iterations and residual of a static solution. laws: rows young [Pa], poisson, normal_stiffness "
	        "[Pa/m], shear_ratio of the contacts between kinds i and j of n, at row i n + j; kinds: kind of each cell (empty: all cells have one kind).");
	py::def("face_point_counts",
	        facePointCounts,
	        py::arg("cells"),
	        "Return the number of points of all contacts, and the number of contacts with equal points instead of the points of the rule.");
}

} // namespace flexpm_bindings
