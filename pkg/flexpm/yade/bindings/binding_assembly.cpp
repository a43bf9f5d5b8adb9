// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Python access to what grains are assembled from, paper Sec. 2.3 and 3.1.
#include <flexpm/yade/bindings/array_view.hpp>
#include <flexpm/yade/bindings/assembly_input.hpp>
#include <flexpm/yade/bindings/binding_discs.hpp>
#include <flexpm/yade/bindings/bindings.hpp>

#include <flexpm/kernel/core/require.hpp>

namespace py = boost::python;

namespace flexpm_bindings {
namespace {

	using Input = AssemblyInput;

	std::shared_ptr<Input> assemblyInput(const std::shared_ptr<flexpm::Tessellation>& cells, py::object centres, py::object radii, double thickness)
	{
		auto input               = std::make_shared<Input>();
		input->tessellation      = cells;
		input->discs             = discs(centres, radii);
		input->options.thickness = thickness;
		return input;
	}

	/// A value of that type, or a refusal of one line.
	template <class Value> Value valueOf(const py::object& given, const char* member, const char* type)
	{
		const py::extract<Value> value(given);
		if (!value.check()) {
			const std::string found = py::extract<std::string>(given.attr("__class__").attr("__name__"));
			flexpm::refuse(std::string("AssemblyInput.") + member, "of type " + found, std::string("must be ") + type + "; flexpm.build gives one");
		}
		return value();
	}
	bool flagOf(const py::object& given, const char* member) { return valueOf<bool>(given, member, "True or False"); }

	template <class T, class List> void assign(List& list, const py::object& array, const char* member)
	{
		const InputArray<T> input(array, 1, member);
		list.assign(input.data(), input.data() + input.size(0));
	}

} // namespace

flexpm::MeshKind meshKind(const std::string& quantity, const std::string& name)
{
	if (name != "fan" && name != "refined") flexpm::refuse(quantity, name, "must be fan or refined; choose one");
	return name == "fan" ? flexpm::MeshKind::fan : flexpm::MeshKind::refined;
}

void register_assembly_bindings()
{
	const auto mesh = +[](const Input& i) { return std::string(i.options.mesh == flexpm::MeshKind::fan ? "fan" : "refined"); };
	py::class_<Input, std::shared_ptr<Input>>(
	        "AssemblyInput",
	        "Arguments of GrainSolver.assemble in addition to the materials. Arrays are copied; arrays that are not given are empty.",
	        py::no_init)
	        .def("__init__",
	             py::make_constructor(
	                     assemblyInput, py::default_call_policies(), (py::arg("tessellation"), py::arg("centres"), py::arg("radii"), py::arg("thickness"))),
	             "Cells, the centres (n, 2) and radii (n,) of their discs [m], and the thickness [m].")
	        .add_property(
	                "rigid",
	                +[](const Input& i) { return i.options.rigid; },
	                +[](Input& i, const py::object& v) { i.options.rigid = flagOf(v, "rigid"); },
	                "Grains are rigid bodies: mesh and Young's modulus do not matter.")
	        .add_property(
	                "mesh",
	                mesh,
	                +[](Input& i, const py::object& v) {
		                i.options.mesh = meshKind("AssemblyInput.mesh", valueOf<std::string>(v, "mesh", "fan or refined"));
	                },
	                "Triangles of a grain: fan or refined.")
	        .add_property(
	                "points",
	                +[](const Input& i) { return i.options.points; },
	                +[](Input& i, const py::object& v) { i.options.points = valueOf<int>(v, "points", "1, 2 or 3"); },
	                "Points of a contact: 3 or 2 (Lobatto), or 1 in the middle of the edge.")
	        .add_property(
	                "centre_line",
	                +[](const Input& i) { return i.options.on_centre_line; },
	                +[](Input& i, const py::object& v) { i.options.on_centre_line = flagOf(v, "centre_line"); },
	                "One point lies where Eq. 7 puts it on the line of centres.")
	        .add_property(
	                "minerals",
	                +[](const Input& i) { return copied(i.options.grain_material, 0); },
	                +[](Input& i, const py::object& v) { assign<int>(i.options.grain_material, v, "minerals"); },
	                "Per cell: index of its material in that list; empty: all the first.")
	        .add_property(
	                "parent",
	                +[](const Input& i) { return copied(i.options.parent, 0); },
	                +[](Input& i, const py::object& v) { assign<int>(i.options.parent, v, "parent"); },
	                "Per cell: the grain of the rock that it is a part of; empty: itself.")
	        .add_property(
	                "outer",
	                +[](const Input& i) { return copied(std::vector<int>(i.outer.begin(), i.outer.end()), 0); },
	                +[](Input& i, const py::object& v) { assign<int>(i.outer, v, "outer"); },
	                "Per shared edge: 1 between two grains of the rock, 0 within one, where contacts are elastic; empty: all 1.")
	        .add_property(
	                "edge_normals",
	                +[](const Input& i) { return i.edgeNormals; },
	                +[](Input& i, const py::object& v) { i.edgeNormals = flagOf(v, "edge_normals"); },
	                "Contacts between two grains of the rock have the normal of their edge, not that between the centres of the cells.")
	        .add_property(
	                "edge_strengths",
	                +[](const Input& i) { return copied(i.options.edge_strength, 0); },
	                +[](Input& i, const py::object& v) { assign<double>(i.options.edge_strength, v, "edge_strengths"); },
	                "Per shared edge: factor of the strengths of its contact [-]; empty: all 1.")
	        .add_property(
	                "edge_joints",
	                +[](const Input& i) { return copied(i.options.edge_joint, 0); },
	                +[](Input& i, const py::object& v) { assign<int>(i.options.edge_joint, v, "edge_joints"); },
	                "Per shared edge: index of its joint in the list of joint materials, -1 for none; empty: all -1.");
}

} // namespace flexpm_bindings
