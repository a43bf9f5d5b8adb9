// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Python side of the layout checks: the report, and C++'s view of the live scene for tests.
#include <flexpm/yade/abi/abi.hpp>
#include <flexpm/yade/abi/yade_lite.hpp>

namespace flexpm_abi {

using namespace yade;
namespace py = boost::python;

namespace {

	/// What follows "kind:" in a falsification like "size:State"; empty for another kind.
	std::string part(const std::string& fault, const std::string& kind) { return fault.rfind(kind + ":", 0) == 0 ? fault.substr(kind.size() + 1) : ""; }

	py::list report(const std::string& fault)
	{
		py::list   rows;
		const auto append = [&](const Findings& found) {
			for (const auto& f : found)
				rows.append(py::make_tuple(f.className, f.check, f.ok, f.detail));
			return std::all_of(found.begin(), found.end(), [](const Finding& f) { return f.ok; });
		};
		// Later checks write into YADE's objects: only safe while the earlier ones hold.
		if (append(checkSizes(part(fault, "size"))) && append(checkTables(part(fault, "vtable")))) append(checkAttributes(part(fault, "attribute")));
		return rows;
	}

	py::dict sceneAsSeen()
	{
		const auto& scene = Omega::instance().getScene();
		py::list    bodies, interactions;
		for (const auto& body : *scene->bodies)
			if (body) bodies.append(py::make_tuple(body->id, body->state->pos, body->shape ? body->shape->getClassName() : ""));
		for (const auto& i : *scene->interactions)
			interactions.append(py::make_tuple(i->getId1(), i->getId2(), i->isReal()));
		py::dict seen;
		seen["dt"]           = scene->dt;
		seen["iter"]         = scene->iter;
		seen["time"]         = scene->time;
		seen["bodies"]       = bodies;
		seen["interactions"] = interactions;
		return seen;
	}

	void addForce(int id, const Vector3r& force, const Vector3r& torque)
	{
		const auto& scene = Omega::instance().getScene();
		scene->forces.addForce(id, force);
		scene->forces.addTorque(id, torque);
		scene->forces.sync();
	}

	py::tuple getForce(int id)
	{
		const auto& scene = Omega::instance().getScene();
		scene->forces.sync();
		return py::make_tuple(Vector3r(scene->forces.getForce(id)), Vector3r(scene->forces.getTorque(id)));
	}

	void addEnergy(const std::string& name, double value)
	{
		int index = -1;
		Omega::instance().getScene()->energy->add(value, name, index);
	}

	bool insertInteraction(int id1, int id2) { return Omega::instance().getScene()->interactions->insert(boost::make_shared<Interaction>(id1, id2)); }

} // namespace

void registerBindings()
{
	py::def("abi_report",
	        report,
	        py::arg("fault") = std::string(),
	        "Compare YADE's classes with the headers of the build: list of (class, check, ok, detail). "
	        "`fault` falsifies one expectation ('size:State', 'vtable:State', 'attribute:State.vel'), to test the check.");
	py::def("abi_scene", sceneAsSeen, "The current scene as the plugin's code sees it.");
	py::def("abi_add_force", addForce, (py::arg("id"), "force", "torque"), "Add force [N] and torque [N m] to a body.");
	py::def("abi_get_force", getForce, py::arg("id"), "Force [N] and torque [N m] of a body.");
	py::def("abi_add_energy", addEnergy, (py::arg("name"), "value"), "Add to a term of O.energy [J].");
	py::def("abi_insert_interaction", insertInteraction, (py::arg("id1"), "id2"), "Insert a potential interaction made by the plugin.");
}

} // namespace flexpm_abi
