// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The engine that owns the packed arrays of the deformable grains and steps them, paper Sec. 2.
#pragma once

#include <flexpm/kernel/forces/outer_forces.hpp>
#include <flexpm/kernel/assembly/solid_state.hpp>
#include <flexpm/kernel/step/step.hpp>
#include <flexpm/kernel/topology/contact_search.hpp>
#include <flexpm/kernel/topology/erasure.hpp>
#include <flexpm/yade/abi/yade_lite.hpp>
#include <flexpm/yade/bindings/array_view.hpp>
#include <flexpm/yade/bindings/assembly_input.hpp>
#include <flexpm/yade/bindings/saved_class.hpp>
#include <flexpm/yade/grains/AssemblyOwner.hpp>

namespace yade {

namespace py = boost::python;

/// A method for Python that asks first whether there are grains of the plane: `call` is the method behind requireAssembled().
template <auto method> struct AfterAssembly;
template <class C, class R, class... A, R (C::*method)(A...)> struct AfterAssembly<method> {
	static R call(C& self, A... a)
	{
		self.requireAssembled();
		return (self.*method)(a...);
	}
};
template <class C, class R, class... A, R (C::*method)(A...) const> struct AfterAssembly<method> {
	static R call(const C& self, A... a)
	{
		self.requireAssembled();
		return (self.*method)(a...);
	}
};

/// The same for a method that grains of space have, too.
template <auto method> struct WithGrains;
template <class C, class R, class... A, R (C::*method)(A...)> struct WithGrains<method> {
	static R call(C& self, A... a)
	{
		self.requireGrains();
		return (self.*method)(a...);
	}
};

class GrainSolver : public GlobalEngine, public AssemblyOwner {
public:
	~GrainSolver() override;
	void action() override;
	/// YADE calls it after it has loaded a scene or set attributes by name.
	void postLoad(GrainSolver&);
	/// YADE calls it before it saves a scene.
	void preSave(GrainSolver&);

	flexpm::Assembly* assembled() override { return assembly.grains.count > 0 ? &assembly : nullptr; }
	bool              holds(int place) const override;
	virtual bool      hasGrains() const { return assembly.grains.count > 0; }
	virtual long      stepsDone() const { return assembly.step; }
	/// @throws std::runtime_error  unless there are grains of the plane, or any; all that Python calls goes through one of them
	void requireAssembled() const;
	void requireGrains() const;
	/// What `call` says of the grains, of the plane or of space.
	template <class Call> auto onState(Call call)
	{
		if (flexpm::SolidState* state = solid()) return call(*state);
		return call(assembly);
	}
	flexpm::Grains&       grains() { return solid() ? solid()->grains : assembly.grains; }
	const flexpm::Grains& grains() const { return const_cast<GrainSolver*>(this)->grains(); }

	/// The arrays for who looks at them: without all that scripts have erased until now.
	flexpm::Assembly& current();
	/// The same for engines, at little cost: without what has been destroyed with its last handle.
	flexpm::Assembly& forEngines();

	/// @throws std::runtime_error  if O.engines holds none with grains
	static shared_ptr<GrainSolver> ofScene(const Scene& scene);

	/// Threads of a step.
	int threads() const;

	/// Let forces act in the next step alone; they are read there.
	void act(const flexpm::OuterForces& forces) { outer = &forces; }

	/// Whether the last step was measured.
	/// @throws std::runtime_error  if measurePeriod is below 1
	bool measured() const;

	void       assemble(const flexpm_bindings::AssemblyInput& input, py::list materials, py::list pairs, py::list joints);
	void       addToScene();
	void       scaleMasses();
	Real       useRealMasses();
	void       mirrorBodies();
	void       resetEnergyBalance();
	py::list   addSidePlates(int side, int pieces, bool bonded, Real friction, Real strip, bool seated);
	int        addTouchingPlate(Vector3r normal, Real friction);
	int        addPatchPlate(Vector3r place, Real length, Vector3r normal, Real friction, bool bonded, Real strip, bool seated);
	int        addJawPlate(Vector3r place, Vector3r centre, Real radius, Real angle, Real friction, Real strip);
	int        findSidePlate(int side, bool bonded, Real friction, Real strip, bool seated);
	int        findPatchPlate(Vector3r place, Real length, Vector3r normal, Real friction, bool bonded, Real strip, bool seated);
	int        findJawPlate(Vector3r place, Vector3r centre, Real radius, Real angle, Real friction, Real strip);
	void       setMachine(int plate, Real stiffness);
	py::tuple  gaugePoints(Vector3r first, Vector3r second);
	py::tuple  sectionNodes(Real place, Vector3r direction, Real width);
	void       fixTangential(int plate);
	py::tuple  nodePlaces(bool bonded);
	int        addNodeSet(vector<int> nodes, bool x, bool y);
	void       turnNodeSet(int set, py::object about);
	void       moveNodeSet(int set, Vector3r velocity);
	py::list   nodeSets();
	void       holdSide(int side, bool x, bool y);
	int        addWall(Vector3r position, Vector3r normal, Real friction);
	Vector3r   gravity() const;
	void       setGravity(Vector3r acceleration);
	py::list   plates();
	py::tuple  elasticConstants();
	py::dict   energies();
	py::dict   snapshot();
	py::tuple  cracks();
	py::tuple  wallForces(vector<int> grains);
	py::dict   parting();
	py::dict   counts();
	py::object sideNodes(int side);
	py::dict   overlaps(Real smallestPart);
	Real       unbalanced();
	Real       crossingSteps(Real diameter);
	py::dict   balance();
	void       clearPressure(int side);

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(GrainSolver, GlobalEngine,
		"Advances all deformable grains by one step: contact points, triangles, nodes [Azevedo2022]_, Eqs. 1-19. Forces are "
		"gathered per grain in a fixed order, so results do not depend on the number of threads. It mirrors the centres to "
		":yref:`State.pos` and :yref:`State.vel`; no :yref:`InteractionLoop` is needed. Bonds and grains may be erased (``O.interactions.erase``, "
		"``O.bodies.erase``): they are gone at the next step or the next call that asks for something, whichever is first. A step does not see "
		"what a script still has a handle of; calls that ask do, and so does the check every checkPeriod steps.",
		((flexpm::Assembly, assembly,, Attr::hidden, "The packed arrays: the one home of the grains' state."))
		((Real, damping, 0.7,, "Local non-viscous damping coefficient alpha, Eq. 2 [-]."))
		((int, measurePeriod, 100,, "Steps between two measurements of kinetic energy and unbalanced force [-]."))
		((int, checkPeriod, 100,, "Steps between two checks for numbers that are not finite, contacts that are over, and what scripts have erased or replaced [-]."))
		((int, mirrorPeriod, 1,, "Steps between two updates of the bodies' states, which the grains do not need [-]; flexpm.run takes that of the checks. With 1, the bonds and O.forces are updated, too, whenever the simulation stops."))
		((int, touchPeriod, 10,, "Steps between two looks for discs that have come to touch [-]."))
		((Real, touchMargin, .2,, "Discs closer than this part of a disc's diameter are watched for a touch until the next check [-]."))
		((vector<Body::id_t>, bodyIds,, Attr::readonly, "Body of each grain [-]."))
		((vector<shared_ptr<Material>>, materials,, Attr::hidden, "Material of each mineral, as given."))
		((vector<vector<Real>>, materialValues,, Attr::hidden, "What was taken from them, see valuesOf()."))
		((Real, massStep, 0., Attr::hidden, "Time step that the masses are scaled for, or the longest that real ones allow; 0 without masses [s]."))
		((Real, massDamping, 0., Attr::hidden, "Damping for which it is so [-]."))
		((int, stepsToCome, 0, Attr::noSave, "Steps of O.step() that a loop has still to do: it stops after the last one [-] |yupdate|."))
		((bool, bondsShown, false, Attr::noSave | Attr::hidden, "The bonds' members hold numbers."))
		((bool, scaled, true, Attr::readonly, "Masses are scaled to the time step; they rise when new contacts need it."))
		((bool, diverged, false, Attr::readonly | Attr::noSave, "A number was not finite any more at a check, or faces of a solid had turned over in a step, which has stopped the simulation |yupdate|."))
		((long, seenDestroyed, 0, Attr::noSave | Attr::hidden, "Destroyed contact handles at the last look for erased bonds."))
		, /* ctor */
		, .def("assemble", &GrainSolver::assemble, (py::arg("input"), py::arg("materials"), py::arg("pairs") = py::list(), py::arg("joints") = py::list()),
			"Build the bonded, unloaded grains, once; flexpm.build calls it. materials: those of the minerals; pairs: of contacts of minerals i and j, at i times their number plus j, all that of i without them; joints: of the joints' contacts.")
		.def("addToScene", WithGrains<&GrainSolver::addToScene>::call, "Make a body of each grain and an interaction of each bond.")
		.def("scaleMasses", AfterAssembly<&GrainSolver::scaleMasses>::call, "Scale the masses for a step of O.dt with the present damping, Sec. 2.4.")
		.def("useRealMasses", AfterAssembly<&GrainSolver::useRealMasses>::call, "Use the real masses; returns the stable time step [s].")
		.def("addSidePlates", AfterAssembly<&GrainSolver::addSidePlates>::call, (py::arg("side"), py::arg("pieces") = 1, py::arg("bonded") = false, py::arg("friction") = 0., py::arg("strip") = 0., py::arg("seated") = false),
			"Lay rigid plates on a side of the outline, side by side, with a layer of a stiffness per area before them (0: none) [Pa/m], seated ones to turn about the middle of their faces, and return their numbers. Scale the masses afterwards.")
		.def("addTouchingPlate", AfterAssembly<&GrainSolver::addTouchingPlate>::call, (py::arg("normal"), py::arg("friction") = 0.),
			"Lay a rigid plate against the outermost point, its normal pointing into the specimen, and return its number. Scale the masses afterwards.")
		.def("addPatchPlate", AfterAssembly<&GrainSolver::addPatchPlate>::call, (py::arg("place"), py::arg("length"), py::arg("normal") = Vector3r::Zero().eval(), py::arg("friction") = 0., py::arg("bonded") = false, py::arg("strip") = 0., py::arg("seated") = false),
			"Lay a rigid plate of a length [m] against the part of the outline around a place [m], its normal pointing into the specimen (zero: that of the outline there), and return its number; strip and seated as above. Scale the masses afterwards.")
		.def("addJawPlate", AfterAssembly<&GrainSolver::addJawPlate>::call, (py::arg("place"), py::arg("centre"), py::arg("radius"), py::arg("angle"), py::arg("friction") = 0., py::arg("strip") = 0.),
			"Lay a rigid arc of a radius [m] around the rim of a disc of this centre [m], over an angle of the disc [rad] about a place on the rim [m], and return its number. Scale the masses afterwards.")
		.def("findSidePlate", AfterAssembly<&GrainSolver::findSidePlate>::call, (py::arg("side"), py::arg("bonded") = false, py::arg("friction") = 0., py::arg("strip") = 0., py::arg("seated") = false),
			"Number of the one plate that addSidePlates has laid along a side with the same arguments, -1 if there is none.")
		.def("findPatchPlate", AfterAssembly<&GrainSolver::findPatchPlate>::call, (py::arg("place"), py::arg("length"), py::arg("normal") = Vector3r::Zero().eval(), py::arg("friction") = 0., py::arg("bonded") = false, py::arg("strip") = 0., py::arg("seated") = false),
			"Number of the plate that addPatchPlate has laid with the same arguments, -1 if there is none.")
		.def("findJawPlate", AfterAssembly<&GrainSolver::findJawPlate>::call, (py::arg("place"), py::arg("centre"), py::arg("radius"), py::arg("angle"), py::arg("friction") = 0., py::arg("strip") = 0.),
			"Number of the plate that addJawPlate has laid with the same arguments, -1 if there is none.")
		.def("setMachine", AfterAssembly<&GrainSolver::setMachine>::call, (py::arg("plate"), py::arg("stiffness")),
			"Lay the spring of a soft machine [N/m] behind a plate, along its normal. What drives the plate then drives its crosshead, the spring's other end.")
		.def("gaugePoints", AfterAssembly<&GrainSolver::gaugePoints>::call, (py::arg("first"), py::arg("second")),
			"The nodes nearest to two places, each on its own side of the middle, and their distance [m], for :yref:`Gauge`.")
		.def("sectionNodes", AfterAssembly<&GrainSolver::sectionNodes>::call, (py::arg("place"), py::arg("direction"), py::arg("width")),
			"The nodes in a band of a width [m] around a place along a direction, a unit vector, and their mean place along it [m], for :yref:`Gauge`.")
		.def("fixTangential", AfterAssembly<&GrainSolver::fixTangential>::call, (py::arg("plate")), "Keep the point that a plate touches first from sliding along it, so that a disc does not roll.")
		.def("nodePlaces", AfterAssembly<&GrainSolver::nodePlaces>::call, (py::arg("bonded") = false), "Nodes that a set may hold, (n,), all of deformable grains and the centres of rigid ones, and where they are, or were when bonded, (n, 2) [m].")
		.def("addNodeSet", AfterAssembly<&GrainSolver::addNodeSet>::call, (py::arg("nodes"), py::arg("x") = true, py::arg("y") = true),
			"Hold nodes of nodePlaces at rest along x, y or both, and return the number of their set.")
		.def("turnNodeSet", AfterAssembly<&GrainSolver::turnNodeSet>::call, (py::arg("set"), py::arg("about") = py::object()),
			"Let a set turn about a point [m], or, with None, about the mean of its places, free to move: a moment alone acts.")
		.def("moveNodeSet", AfterAssembly<&GrainSolver::moveNodeSet>::call, (py::arg("set"), py::arg("velocity")),
			"Move a set from the next step on: velocity along x and y [m/s, or m per step with scaled masses]; z: spin [rad/s].")
		.def("nodeSets", AfterAssembly<&GrainSolver::nodeSets>::call, "Each node set as a dictionary: nodes, axes that it holds, whether it floats, place of its pivot [m], displacement [m], angle [rad], force on the specimen [N], moment about the pivot [N m], work that it has done [J].")
		.def("holdSide", AfterAssembly<&GrainSolver::holdSide>::call, (py::arg("side"), py::arg("x") = false, py::arg("y") = false),
			"Keep a side of the outline from moving along x, y or both: nodes of deformable grains; of rigid grains the centres across the side, and the edges along it.")
		.def("addWall", AfterAssembly<&GrainSolver::addWall>::call, (py::arg("position"), py::arg("normal"), py::arg("friction") = 0.),
			"Lay a rigid plate apart from the specimen, its normal pointing to it, that the corners of any grain may come to touch, and return its number. Scale the masses afterwards.")
		.add_property("gravity", AfterAssembly<&GrainSolver::gravity>::call, AfterAssembly<&GrainSolver::setGravity>::call, "Acceleration of all masses, which must be real ones [m/s^2].")
		.def("plates", AfterAssembly<&GrainSolver::plates>::call, "Each plate as a dictionary: side, normal, width [m], friction [-], whether it is bonded and pressed, place of its face [m], work that it has done [J], displacement [m], velocity [m/s], force on the specimen [N], contact_width [m].")
		.def("mirrorBodies", WithGrains<&GrainSolver::mirrorBodies>::call, "Update what YADE sees of the grains now, whatever mirrorPeriod is: states, bonds, forces.")
		.def("resetEnergyBalance", AfterAssembly<&GrainSolver::resetEnergyBalance>::call, "Count works and dissipation from now; the present energy becomes the initial one.")
		.def("elasticConstants", AfterAssembly<&GrainSolver::elasticConstants>::call, "Young's modulus [Pa] and Poisson's ratio [-] of a rectangle, by one sparse solve.")
		.def("energies", WithGrains<&GrainSolver::energies>::call, "Energies of the last step [J], by name. erased_energy has left with erased grains and bonds; boundary_work and initial_energy make up the sum of all others.")
		.def("snapshot", AfterAssembly<&GrainSolver::snapshot>::call, "The state as plain arrays, by name (see the documentation's list of arrays): of what exists, and the record of erased bonds.")
		.def("cracks", WithGrains<&GrainSolver::cracks>::call, "Numbers of cracked points: (tensile, shear). Points of erased bonds did not crack.")
		.def("wallForces", AfterAssembly<&GrainSolver::wallForces>::call, (py::arg("grains")), "Nodes on which some grains act from outside of them, and their forces there, x and y, at the last step [N], for :yref:`ReleaseController`.")
		.def("parting", AfterAssembly<&GrainSolver::parting>::call, "Largest growth of the distance between grains that were bonded to each other [m]: of any pair, and of those standing, of which neither is loose; loose: number of grains that no contact joins any more to what is held, which no pressure acts on.")
		.def("counts", AfterAssembly<&GrainSolver::counts>::call, "Numbers of grains, particles (what moves: grains or inner particles), contacts between and within grains as bonded, contacts that have come since, nodes, triangles, mesh groups and boundary edges; nothing erased counts.")
		.def("overlaps", AfterAssembly<&GrainSolver::overlaps>::call, (py::arg("smallest") = 1e-3),
			"Pairs of grains whose polygons overlap by more than a part of the smaller one, by name: grains (n, 2), area that both cover [m^2], part of the smaller grain [-], bonded (once, not on a joint), facing (bonded, and the faces lie as they did), closed: normal force of the pair over its stiffness and the thickness, the area that this accounts for [m^2].")
		.def("unbalanced", WithGrains<&GrainSolver::unbalanced>::call, "Ratio of the largest unbalanced force to the mean contact force [-], at the last measured step; forces on plates under a load count per grain before them.")
		.def("crossingSteps", AfterAssembly<&GrainSolver::crossingSteps>::call, (py::arg("diameter")), "Steps of O.dt in which a wave crosses a disc of the grains of a diameter [m] [-].")
		.def("balance", AfterAssembly<&GrainSolver::balance>::call,
			"How far the specimen is in balance as a whole, at the last step, as a dictionary. mean_stress: mean of its Cauchy stress, (xx, yy, xy), tension positive [Pa]; "
			"of rigid grains by the contact forces and branches. outside_stress: what pressure, plates, held nodes and weight would make of it in balance [Pa]. "
			"missing_force: sum of the net forces on all that is free to move, (x, y) [N]. plate_share: largest part of its load that "
			"the specimen does not bear of a plate under one [-]. A wave sets the two stresses apart while unbalanced() is small.")
		.def("clearPressure", AfterAssembly<&GrainSolver::clearPressure>::call, (py::arg("side")), "Take the pressure off a side of the outline.")
		.def("sideNodes", AfterAssembly<&GrainSolver::sideNodes>::call, (py::arg("side")), "(grain, node) pairs on a side of the outline, (n, 2).")
	);
	// clang-format on
	DECLARE_LOGGER;

protected:
	static vector<shared_ptr<Material>> materialsOf(const py::list& list);
	void                                keepMaterials(const vector<shared_ptr<Material>>& ofGrains);
	void                                requirePeriods() const;
	void                                requireMasses() const;
	void                                requireOwnValues() const;
	void                                requireInScene() const;
	void                                requireOwnScene() const;
	flexpm::StepOptions                 stepOptions() const;
	void                                trackEnergies();
	void                                check();
	void                                mirrorAtStop();
	virtual void                        findStates();
	virtual void                        mirrorStates();
	/// Take out what scripts have erased.
	virtual void removeErased();
	bool         isInScene() const;
	bool         hasInteraction(int contact) const;
	/// The body of a grain, null if a script has erased it.
	Body* bodyOf(const Scene& world, int grain) const;
	/// The arrays, as shapes and bonds look at them.
	OwnedAssembly own() const;

	vector<shared_ptr<State>> states; // of the bodies, by slot, of solids by grain; kept alive, so that a body may go at any time

private:
	flexpm::NearPairs           nearPairs;
	vector<flexpm::GrainPair>   candidates;       // near pairs without a contact
	bool                        listed = false;   // the candidates are up to date
	const flexpm::OuterForces*  outer  = nullptr; // of the next step
	mutable vector<std::size_t> places;           // of the contacts among the interactions, when last seen
	void                        requireReady() const;
	void                        takeStep();
	void                        insertBodies();
	void                        insertContacts();
	/// What scripts have erased since the last look.
	flexpm::Erasure findErased() const;
	void            listCandidates();
	void            changeContacts();
	void            limitStep();
	void            insertTouches(int firstId);
	void            followFaces();
	void            showContactOf(const flexpm::GrainPair& pair);
	void            showContact(int place);
	void            mirrorBonds(const Scene& world);
	void            hideBonds(const Scene& world);
	void            mirrorForces(Scene& world);
};
REGISTER_SAVED(GrainSolver);

} // namespace yade
