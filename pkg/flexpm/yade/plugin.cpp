// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The Python module _flexpm: registers the plugin's classes with YADE and the kernel's functions with Python.
#include <flexpm/yade/abi/abi.hpp>
#include <flexpm/yade/abi/yade_lite.hpp>
#include <flexpm/yade/bindings/assembly_archive.hpp>
#include <flexpm/yade/bindings/bindings.hpp>

#include <boost/python/stl_iterator.hpp>

namespace py = boost::python;

namespace {

/// Register the classes that YADE does not know yet, and no others.
///
/// YADE's own loader registers everything in ClassFactory::pluginClasses again, which warns for each class of
/// YADE; so the list is reduced to ours for the call and restored after it. A second call finds nothing new.
py::list registerClasses()
{
	auto&      names   = yade::ClassFactory::instance().pluginClasses;
	const auto all     = names;
	py::object wrapper = py::import("yade.wrapper");
	names.remove_if([&](const std::string& name) { return PyObject_HasAttrString(wrapper.ptr(), name.c_str()) != 0; });
	names.sort();
	names.unique();
	static std::vector<std::string> registered;
	registered.insert(registered.end(), names.begin(), names.end());
	yade::Omega::instance().loadPlugins({});
	names = all;
	py::list ours;
	for (const auto& name : registered)
		ours.append(name);
	return ours;
}

/// Let a renderer that exists already draw classes registered after it was made.
void refreshRenderer(py::object renderer)
{
	yade::OpenGLRenderer& known = py::extract<yade::OpenGLRenderer&>(renderer);
	known.init();
}

/// Give the scene its engines, as an assignment to O.engines does.
///
/// YADE's own assignment keeps a reference to each item of the list for ever, and so all that a solver holds.
void setEngines(py::list engines)
{
	using Engines       = std::vector<boost::shared_ptr<yade::Engine>>;
	const auto&   scene = yade::Omega::instance().getScene();
	const Engines chosen { py::stl_input_iterator<boost::shared_ptr<yade::Engine>>(engines), {} };
	// the list of a step that runs must stay until it ends
	auto& list = scene->subStep < 0 ? scene->engines : scene->_nextEngines;
	list       = chosen;
}

py::dict buildInfo()
{
	py::dict info;
	info["version"]      = FLEXPM_VERSION;
	info["yade_headers"] = FLEXPM_YADE_HEADERS;
	info["yade_library"] = FLEXPM_YADE_LIBRARY;
	info["compiler"]     = "g++ " __VERSION__;
	info["glibc"]        = std::to_string(__GLIBC__) + "." + std::to_string(__GLIBC_MINOR__);
	info["boost"]        = BOOST_LIB_VERSION;
	return info;
}

} // namespace

BOOST_PYTHON_MODULE(_flexpm)
{
	py::scope().attr("build_info")  = buildInfo();
	py::scope().attr("saved_state") = boost::serialization::assemblyVersion;
	py::def("refresh_renderer", refreshRenderer, py::arg("renderer"), "Make an existing renderer know the plugin's shapes.");
	py::def("set_engines", setEngines, py::arg("engines"), "Give the scene its engines; unlike O.engines it lets them go with the scene.");
	flexpm_abi::registerBindings();
	flexpm_bindings::register_geometry_bindings();
	flexpm_bindings::register_assembly_bindings();
	flexpm_bindings::register_instruction_set_bindings();
	flexpm_bindings::register_laboratory_bindings();
	flexpm_bindings::register_subdivision_bindings();
	flexpm_bindings::register_tiling_bindings();
	flexpm_bindings::register_space_bindings();
	flexpm_bindings::register_label_bindings();
	// called by the package once the layout check has passed, not at load
	py::def("register_classes", registerClasses, "Register the plugin's classes with YADE, once; returns their names.");
}
