// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The engine that owns the packed arrays of the deformable grains and steps them, paper Sec. 2.
#pragma once

#include <flexpm/kernel/step/step.hpp>
#include <flexpm/kernel/topology/contact_search.hpp>
#include <flexpm/yade/abi/yade_lite.hpp>
#include <flexpm/yade/bindings/array_view.hpp>
#include <flexpm/yade/bindings/assembly_archive.hpp>
#include <flexpm/yade/grains/AssemblyOwner.hpp>

namespace yade {

namespace py = boost::python;

class GrainSolver : public GlobalEngine, public AssemblyOwner {
public:
	~GrainSolver() override;
	void action() override;
	/// YADE calls it after it has loaded a scene.
	void postLoad(GrainSolver&);

	flexpm::Assembly& arrays() override { return assembly; }

	/// @throws std::runtime_error  if O.engines holds none
	static shared_ptr<GrainSolver> ofScene(const Scene& scene);

	/// Whether the last step was measured.
	bool measured() const { return assembly.step % measurePeriod == 0; }

	void       assemble(py::object tessellation, py::object centres, py::object radii, Real thickness, py::list materials, py::dict options);
	void       addToScene(py::list materials);
	void       scaleMasses();
	Real       useRealMasses();
	void       mirrorBodies();
	void       openBooks();
	py::list   addSidePlates(int side, int pieces, bool bonded, Real friction);
	int        addTouchingPlate(Vector3r normal, Real friction);
	void       holdSideways(int plate);
	int        addWall(Vector3r position, Vector3r normal, Real friction);
	Vector3r   gravity() const;
	void       setGravity(Vector3r acceleration);
	py::list   plates() const;
	py::tuple  elasticConstants() const;
	py::dict   energies() const;
	py::dict   snapshot() const;
	py::tuple  cracks() const;
	py::dict   counts() const;
	py::object sideNodes(int side) const;
	Real       unbalanced() const;
	void       clearPressure(int side);

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(GrainSolver, GlobalEngine,
		"Advances all deformable grains by one step: contact points, triangles, nodes [Azevedo2022]_, Eqs. 1-19. Forces are "
		"gathered per grain in a fixed order, so results do not depend on the number of threads. It mirrors the centres to "
		":yref:`State.pos` and :yref:`State.vel`; no :yref:`InteractionLoop` is needed.",
		((flexpm::Assembly, assembly,, Attr::hidden, "The packed arrays: the one home of the grains' state."))
		((Real, damping, 0.7,, "Local non-viscous damping coefficient alpha, Eq. 2 [-]."))
		((int, measurePeriod, 100,, "Steps between two measurements of kinetic energy and unbalanced force [-]."))
		((int, checkPeriod, 100,, "Steps between two checks for numbers that are not finite, contacts that are over, and what scripts have erased or replaced [-]."))
		((int, mirrorPeriod, 1,, "Steps between two updates of the bodies' states, which the grains do not need [-]; flexpm.run takes that of the checks."))
		((int, touchPeriod, 10,, "Steps between two looks for discs that have come to touch [-]."))
		((Real, touchMargin, .2,, "Discs closer than this part of a disc's diameter are watched for a touch until the next check [-]."))
		((vector<Body::id_t>, bodyIds,, Attr::readonly, "Body of each grain [-]."))
		((bool, scaled, true, Attr::readonly, "Masses are scaled to the time step; they rise when new contacts need it."))
		((bool, diverged, false, Attr::readonly | Attr::noSave, "A number was not finite any more at a check, which has stopped the simulation |yupdate|."))
		((long, seenDestroyed, 0, Attr::noSave | Attr::hidden, "Destroyed contact handles at the last look for erased bonds."))
		, /* ctor */
		, .def("assemble", &GrainSolver::assemble, (py::arg("tessellation"), py::arg("centres"), py::arg("radii"), py::arg("thickness"), py::arg("materials"), py::arg("options")),
			"Build the bonded, unloaded grains; flexpm.build calls it.")
		.def("addToScene", &GrainSolver::addToScene, (py::arg("materials")), "Make a body of each grain and an interaction of each bond.")
		.def("scaleMasses", &GrainSolver::scaleMasses, "Scale the masses for a step of O.dt with the present damping, Sec. 2.4.")
		.def("useRealMasses", &GrainSolver::useRealMasses, "Use the real masses; returns the stable time step [s].")
		.def("addSidePlates", &GrainSolver::addSidePlates, (py::arg("side"), py::arg("pieces") = 1, py::arg("bonded") = false, py::arg("friction") = 0.),
			"Lay rigid plates on a side of the outline, side by side, and return their numbers. Scale the masses afterwards.")
		.def("addTouchingPlate", &GrainSolver::addTouchingPlate, (py::arg("normal"), py::arg("friction") = 0.),
			"Lay a rigid plate against the outermost point, its normal pointing into the specimen, and return its number. Scale the masses afterwards.")
		.def("holdSideways", &GrainSolver::holdSideways, (py::arg("plate")), "Keep the point that a plate touches first from sliding along it, so that a disc does not roll.")
		.def("addWall", &GrainSolver::addWall, (py::arg("position"), py::arg("normal"), py::arg("friction") = 0.),
			"Lay a rigid plate apart from the specimen, its normal pointing to it, that the corners of any grain may come to touch, and return its number. Scale the masses afterwards.")
		.add_property("gravity", &GrainSolver::gravity, &GrainSolver::setGravity, "Acceleration of all masses, which must be real ones [m/s^2].")
		.def("plates", &GrainSolver::plates, "Each plate as a dictionary: side, normal, width [m], displacement [m], velocity [m/s], force on the specimen [N], contact_width [m].")
		.def("mirrorBodies", &GrainSolver::mirrorBodies, "Update the states of the bodies now, whatever mirrorPeriod is.")
		.def("openBooks", &GrainSolver::openBooks, "Count works and dissipation from now; the present energy becomes the initial one.")
		.def("elasticConstants", &GrainSolver::elasticConstants, "Young's modulus [Pa] and Poisson's ratio [-] of a rectangle, by one sparse solve.")
		.def("energies", &GrainSolver::energies, "Energies of the last step [J], by name.")
		.def("snapshot", &GrainSolver::snapshot, "The state as plain arrays, by name (see the documentation's list of arrays).")
		.def("cracks", &GrainSolver::cracks, "Numbers of cracked points: (tensile, shear).")
		.def("counts", &GrainSolver::counts, "Numbers of grains, particles (what moves: grains or inner particles), contacts between and within grains as bonded, contacts that have come since, nodes, triangles, mesh groups and boundary edges.")
		.def("unbalanced", &GrainSolver::unbalanced, "Largest unbalanced over mean contact force [-], at the last measured step.")
		.def("clearPressure", &GrainSolver::clearPressure, (py::arg("side")), "Take the pressure off a side of the outline.")
		.def("sideNodes", &GrainSolver::sideNodes, (py::arg("side")), "(grain, node) pairs on a side of the outline, (n, 2).")
	);
	// clang-format on
	DECLARE_LOGGER;

private:
	flexpm::NearPairs         nearPairs;
	vector<flexpm::GrainPair> candidates;     // near pairs without a contact
	bool                      listed = false; // the candidates are up to date
	vector<std::size_t>       places;         // of the contacts among the interactions, when last seen
	vector<shared_ptr<State>> states;         // of the bodies, by slot; kept alive, so that a body may go at any time
	void                      takeStep();
	void                      insertBodies(const vector<shared_ptr<Material>>& materials);
	void                      insertContacts();
	void                      findStates();
	bool                      hasInteraction(int contact);
	void                      retireErased();
	void                      listCandidates();
	void                      changeContacts();
	void                      limitStep();
	void                      insertTouches(int firstId);
	void                      check();
};
REGISTER_SERIALIZABLE(GrainSolver);

} // namespace yade
