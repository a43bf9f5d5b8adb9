// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The engine that owns the packed arrays of the grains, in 2D or 3D, and steps them, paper Sec. 2.
#pragma once

#include <flexpm/kernel/assembly/solid_state.hpp>
#include <flexpm/kernel/forces/outer_forces.hpp>
#include <flexpm/kernel/space/polyhedra.hpp>
#include <flexpm/kernel/space/solid.hpp>
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

/// A method for Python that asks first what grains there are: `call` is the method behind `require`.
template <auto require, auto method> struct After;
template <class C, class R, class... A, void (C::*require)() const, R (C::*method)(A...)> struct After<require, method> {
	static R call(C& self, A... a)
	{
		(self.*require)();
		self.showNodes();
		return (self.*method)(a...);
	}
};
template <class C, class R, class... A, void (C::*require)() const, R (C::*method)(A...) const> struct After<require, method> {
	static R call(const C& self, A... a)
	{
		(self.*require)();
		self.showNodes();
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

	flexpm::Assembly*   assembled() override { return assembly.grains.count > 0 ? &assembly : nullptr; }
	flexpm::SolidState* solid() override { return isSolid() ? &space : nullptr; }
	bool                isSolid() const { return space.grains.count > 0; }
	void                showNodes() const override;
	/// The state in 3D for engines, which read places of nodes but no forces on them; null in 2D.
	flexpm::SolidState* placed();
	bool                holds(int place) const override;
	/// Components of a vector of the grains; 0 without grains.
	int  dimension() const { return isSolid() ? 3 : assembly.grains.count > 0 ? 2 : 0; }
	bool hasGrains() const { return grainCount() > 0; }
	int  grainCount() const { return isSolid() ? space.grains.count : assembly.grains.count; }
	/// The part of the state that both dimensions have.
	flexpm::BondedState&       state() { return placed() ? static_cast<flexpm::BondedState&>(space) : assembly; }
	const flexpm::BondedState& state() const { return const_cast<GrainSolver*>(this)->state(); }
	long                       stepsDone() const { return isSolid() ? space.step : assembly.step; }
	/// @throws std::runtime_error  unless there are grains of 2D, of 3D, or any; all that Python calls goes through one of them
	void requirePlane() const;
	void requireSolid() const;
	void requireGrains() const;
	/// Result of `call` with the state, of 2D or of 3D.
	template <class Call> auto onState(Call call)
	{
		if (flexpm::SolidState* state = placed()) return call(*state);
		return call(assembly);
	}
	/// The same for who comes at each step and reads no nodes.
	template <class Call> auto betweenSteps(Call call)
	{
		if (isSolid()) return call(space);
		return call(assembly);
	}
	flexpm::Grains&       grains() { return state().grains; }
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

	void assemble(const flexpm_bindings::AssemblyInput& input, py::list materials, py::list pairs, py::list joints);
	void assembleSolid(
	        const flexpm::Polyhedra& cells,
	        const flexpm::Solid&     outline,
	        py::list                 materials,
	        py::list                 pairs,
	        vector<int>              minerals,
	        bool                     rigid,
	        vector<Real>             strengths,
	        py::list                 joints,
	        vector<int>              contactJoints);
	void      takeBonds();
	void      addToScene();
	void      scaleMasses();
	Real      useRealMasses();
	void      mirrorBodies();
	void      resetEnergyBalance();
	py::list  addSidePlates(int side, int pieces, bool bonded, Real friction, Real strip, bool seated);
	int       addTouchingPlate(Vector3r normal, Real friction);
	int       addPatchPlate(Vector3r place, Real length, Vector3r normal, Real friction, bool bonded, Real strip, bool seated);
	int       addJawPlate(Vector3r place, Vector3r centre, Real radius, Real angle, Real friction, Real strip);
	int       findSidePlate(int side, bool bonded, Real friction, Real strip, bool seated);
	int       findPatchPlate(Vector3r place, Real length, Vector3r normal, Real friction, bool bonded, Real strip, bool seated);
	int       findJawPlate(Vector3r place, Vector3r centre, Real radius, Real angle, Real friction, Real strip);
	void      holdEnds(bool bonded, Real friction);
	void      holdBottom(bool plate);
	void      holdDisc(Real jawRadius);
	int       layLine(int side, Real x, Real z, Real width, bool pinned);
	int       findLine(int side, Real x, Real z, Real width, bool pinned);
	int       layPatch(Vector3r normal, Vector3r low, Vector3r high, Real friction, bool bonded, Real strip, bool seated);
	int       findPatch(Vector3r normal, Vector3r low, Vector3r high, Real friction, bool bonded, Real strip, bool seated);
	int       layJaw(Vector3r towards, Real ratio, Real angle, Real friction, Real strip);
	int       findJaw(Vector3r towards, Real ratio, Real angle, Real friction, Real strip);
	void      freePlate(int plate);
	void      setMachine(int plate, Real stiffness);
	py::tuple gaugePoints(Vector3r first, Vector3r second);
	py::tuple sectionNodes(Real place, Vector3r direction, Real width);
	void      fixTangential(int plate);
	py::tuple nodePlaces(bool bonded);
	int       addNodeSet(vector<int> nodes, bool x, bool y, bool z);
	void      turnNodeSet(int set, py::object about);
	void      moveNodeSet(int set, Vector3r velocity, Vector3r spin);
	py::list  nodeSets();
	void      holdSide(int side, bool x, bool y, bool z);
	int       addWall(Vector3r position, Vector3r normal, Real friction);
	Vector3r  gravity() const;
	void      setGravity(Vector3r acceleration);
	py::list  plates();
	py::tuple elasticConstants();
	py::dict  energies();
	py::dict  snapshot();
	/// That of any state in 3D.
	static py::dict snapshotOf(const flexpm::SolidState& state);
	py::tuple       cracks();
	py::tuple       wallForces(vector<int> grains);
	py::dict        parting();
	py::dict        counts();
	py::object      sideNodes(int side);
	py::dict        overlaps(Real smallestPart);
	py::dict        pairs();
	Real            unbalanced();
	Real            crossingSteps(Real diameter);
	py::dict        balance();
	void            clearPressure(int side);

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(GrainSolver, GlobalEngine,
		"Advances all grains by one step, in 2D or 3D: contact points, triangles or tetrahedra, nodes [Azevedo2022]_, Eqs. 1-19. Forces are "
		"gathered per grain in a fixed order, so results do not depend on the number of threads. It mirrors the centres to "
		":yref:`State.pos` and :yref:`State.vel`; no :yref:`InteractionLoop` is needed. Bonds and grains may be erased (``O.interactions.erase``, "
		"``O.bodies.erase``): they are removed at the next step or the next query, whichever is first. A step does not "
		"detect an erasure while a script still has a handle of the object; queries detect it, and so does the check every checkPeriod steps. "
		"In 3D grains and bonds must not be erased: the next step raises an error.",
		((flexpm::Assembly, assembly,, Attr::hidden, "The packed arrays of grains in 2D, the only copy of their state."))
		((flexpm::SolidState, space,, Attr::hidden, "The packed arrays of grains in 3D, the only copy of their state."))
		((Real, damping, 0.7,, "Local non-viscous damping coefficient alpha, Eq. 2 [-]."))
		((int, measurePeriod, 100,, "Steps between two measurements of kinetic energy and unbalanced force [-]."))
		((int, checkPeriod, 100,, "Steps between two checks for numbers that are not finite, contacts that have ended, in 3D pairs of near grains and their clearances, and bodies that scripts have erased or replaced [-]."))
		((int, mirrorPeriod, 1,, "Steps between two updates of the bodies' states, which the grains do not need [-]; flexpm.run uses the period of the checks. With 1, the bonds and O.forces are updated, too, whenever the simulation stops."))
		((int, touchPeriod, 10,, "Steps between two searches for discs that touch [-]."))
		((Real, touchMargin, .2,, "Ratio of a distance to the diameter of a disc: closer discs are observed for new contacts until the next check [-]."))
		((vector<Body::id_t>, bodyIds,, Attr::readonly, "Body of each grain [-]."))
		((vector<shared_ptr<Material>>, materials,, Attr::hidden, "Material of each mineral, as given."))
		((vector<vector<Real>>, materialValues,, Attr::hidden, "Values of the materials in use, see valuesOf()."))
		((Real, massStep, 0., Attr::hidden, "Time step for which the masses are scaled, or the stable time step of real masses; 0 without masses [s]."))
		((Real, massDamping, 0., Attr::hidden, "Damping factor for which this time step is stable [-]."))
		((int, stepsToCome, 0, Attr::noSave, "Remaining steps of a loop of O.step(), which stops after the last step [-] |yupdate|."))
		((bool, bondsShown, false, Attr::noSave | Attr::hidden, "The members of the bonds have present values."))
		((bool, scaled, true, Attr::readonly, "Masses are scaled to the time step; they increase if new contacts require it."))
		((bool, diverged, false, Attr::readonly | Attr::noSave, "The simulation was stopped: a number was not finite at a check, faces were inverted in a 3D step, or gravity had detached a grain in 3D |yupdate|."))
		((string, stopReason, "", Attr::readonly | Attr::noSave, "Reason of this stop, in one line |yupdate|."))
		((long, seenDestroyed, 0, Attr::noSave | Attr::hidden, "Destroyed contact handles at the last search for erased bonds."))
		, /* ctor */
		, .def("assemble", &GrainSolver::assemble, (py::arg("input"), py::arg("materials"), py::arg("pairs") = py::list(), py::arg("joints") = py::list()),
			"Build the bonded, unloaded grains; flexpm.build calls it once. materials: material of each mineral; pairs: material of the contacts between minerals i and j of n, at index i n + j (empty: the material of i); joints: material of the contacts of each joint.")
		.def("assembleSolid", &GrainSolver::assembleSolid, (py::arg("cells"), py::arg("outline"), py::arg("materials"), py::arg("pairs") = py::list(), py::arg("minerals") = vector<int>(), py::arg("rigid") = false, py::arg("strengths") = vector<Real>(), py::arg("joints") = py::list(), py::arg("contact_joints") = vector<int>()),
			"Build the bonded, unloaded grains; flexpm.build calls it once. materials: material of each mineral; pairs: material of the contacts between minerals i and j of n, at index i n + j; minerals: mineral of each cell; strengths: factor of the strengths of each contact [-] (empty: all 1).")
		.def("takeBonds", After<&GrainSolver::requireGrains, &GrainSolver::takeBonds>::call, "Take the strength of all bonds, before the first step: the grains press on each other and slide with friction. This counts as no crack.")
		.def("addToScene", After<&GrainSolver::requireGrains, &GrainSolver::addToScene>::call, "Make a body of each grain and an interaction of each bond.")
		.def("scaleMasses", After<&GrainSolver::requireGrains, &GrainSolver::scaleMasses>::call, "Scale the masses for a step of O.dt with the present damping, Sec. 2.4.")
		.def("useRealMasses", After<&GrainSolver::requireGrains, &GrainSolver::useRealMasses>::call, "Use the real masses, and return the stable time step [s].")
		.def("addSidePlates", After<&GrainSolver::requirePlane, &GrainSolver::addSidePlates>::call, (py::arg("side"), py::arg("pieces") = 1, py::arg("bonded") = false, py::arg("friction") = 0., py::arg("strip") = 0., py::arg("seated") = false),
			"Place rigid plates side by side on a side of the outline, with a soft layer in between. strip: stiffness per area of the layer [Pa/m], 0: no layer; seated plates rotate about the middle of their faces. Return their indices. Scale the masses afterwards.")
		.def("addTouchingPlate", After<&GrainSolver::requirePlane, &GrainSolver::addTouchingPlate>::call, (py::arg("normal"), py::arg("friction") = 0.),
			"Place a rigid plate against the outermost point, its normal pointing into the specimen, and return its index. Scale the masses afterwards.")
		.def("addPatchPlate", After<&GrainSolver::requirePlane, &GrainSolver::addPatchPlate>::call, (py::arg("place"), py::arg("length"), py::arg("normal") = Vector3r::Zero().eval(), py::arg("friction") = 0., py::arg("bonded") = false, py::arg("strip") = 0., py::arg("seated") = false),
			"Place a rigid plate of a length [m] against the part of the outline around a position [m], its normal pointing into the specimen (zero: the normal of the outline there), and return its index; strip and seated as above. Scale the masses afterwards.")
		.def("addJawPlate", After<&GrainSolver::requirePlane, &GrainSolver::addJawPlate>::call, (py::arg("place"), py::arg("centre"), py::arg("radius"), py::arg("angle"), py::arg("friction") = 0., py::arg("strip") = 0.),
			"Place a rigid arc of a radius [m] around the rim of a disc of this centre [m], over an angle of the disc [rad] about a position on the rim [m], and return its index. Scale the masses afterwards.")
		.def("findSidePlate", After<&GrainSolver::requirePlane, &GrainSolver::findSidePlate>::call, (py::arg("side"), py::arg("bonded") = false, py::arg("friction") = 0., py::arg("strip") = 0., py::arg("seated") = false),
			"Return the index of the single plate that addSidePlates has placed along a side with the same arguments, or -1.")
		.def("findPatchPlate", After<&GrainSolver::requirePlane, &GrainSolver::findPatchPlate>::call, (py::arg("place"), py::arg("length"), py::arg("normal") = Vector3r::Zero().eval(), py::arg("friction") = 0., py::arg("bonded") = false, py::arg("strip") = 0., py::arg("seated") = false),
			"Return the index of the plate that addPatchPlate has placed with the same arguments, or -1.")
		.def("findJawPlate", After<&GrainSolver::requirePlane, &GrainSolver::findJawPlate>::call, (py::arg("place"), py::arg("centre"), py::arg("radius"), py::arg("angle"), py::arg("friction") = 0., py::arg("strip") = 0.),
			"Return the index of the plate that addJawPlate has placed with the same arguments, or -1.")
		.def("holdEnds", After<&GrainSolver::requireSolid, &GrainSolver::holdEnds>::call, (py::arg("bonded") = false, py::arg("friction") = 0.),
			"Fix the bottom and the top along z; they may move laterally. Nodes of deformable grains are fixed, rigid grains get plates, which also pull if they are bonded. With a friction above 0 [-] all grains get plates, to which they stick within the friction. Scale the masses afterwards.")
		.def("holdBottom", After<&GrainSolver::requireSolid, &GrainSolver::holdBottom>::call, (py::arg("plate") = false), "Fix the bottom along z in the same way, if it is free, and one position on it laterally; the top may be under a pressure. plate: use a plate also for deformable grains.")
		.def("holdDisc", After<&GrainSolver::requireSolid, &GrainSolver::holdDisc>::call, (py::arg("jawRadius") = 0.), "Place smooth plates below and on top of a disc, or jaws of a radius [m]. The surface that they touch first is fixed along x, and a single position on it along y, to prevent rolling. Scale the masses afterwards.")
		.def("layLine", After<&GrainSolver::requireSolid, &GrainSolver::layLine>::call, (py::arg("side"), py::arg("x"), py::arg("z"), py::arg("width"), py::arg("pinned") = false),
			"Place a plate that carries load along a line across the depth, along y at x and z, with the stiffness of a strip of that width [m]: a roller on the bottom (side 0) or a head on top (2). pinned: it does not slide while it presses. Returns its index. Scale the masses afterwards.")
		.def("findLine", After<&GrainSolver::requireSolid, &GrainSolver::findLine>::call, (py::arg("side"), py::arg("x"), py::arg("z"), py::arg("width"), py::arg("pinned") = false), "Return the index of the plate that layLine has placed with the same arguments, or -1.")
		.def("layPatch", After<&GrainSolver::requireSolid, &GrainSolver::layPatch>::call, (py::arg("normal"), py::arg("low"), py::arg("high"), py::arg("friction") = 0., py::arg("bonded") = false, py::arg("strip") = 0., py::arg("seated") = false),
			"Place a plate against the part of the surface in a box from low to high [m] that faces a normal, a unit vector that points into the specimen. friction: coefficient [-]; bonded: it also pulls; strip: stiffness per area of a soft layer between, in series [Pa/m]; seated: it rotates about the middle of its face, as on a spherical seat. Returns its index. Scale the masses afterwards.")
		.def("findPatch", After<&GrainSolver::requireSolid, &GrainSolver::findPatch>::call, (py::arg("normal"), py::arg("low"), py::arg("high"), py::arg("friction") = 0., py::arg("bonded") = false, py::arg("strip") = 0., py::arg("seated") = false), "Return the index of the plate that layPatch has placed with the same arguments, or -1.")
		.def("layJaw", After<&GrainSolver::requireSolid, &GrainSolver::layJaw>::call, (py::arg("towards"), py::arg("ratio"), py::arg("angle"), py::arg("friction") = 0., py::arg("strip") = 0.),
			"Place a curved jaw against the lateral surface of a disc about the y axis, in a direction from this axis, over an angle [rad]. ratio: of its radius to the radius of the disc, at least 1; friction: coefficient [-]; strip: as in layPatch. Returns its index. Scale the masses afterwards.")
		.def("findJaw", After<&GrainSolver::requireSolid, &GrainSolver::findJaw>::call, (py::arg("towards"), py::arg("ratio"), py::arg("angle"), py::arg("friction") = 0., py::arg("strip") = 0.), "Return the index of the plate that layJaw has placed with the same arguments, or -1.")
		.def("freePlate", After<&GrainSolver::requireSolid, &GrainSolver::freePlate>::call, (py::arg("plate")), "Allow a load to move a plate along its normal, for :yref:`PressureController`; the plate is fixed until then. Scale the masses afterwards.")
		.def("setMachine", After<&GrainSolver::requireGrains, &GrainSolver::setMachine>::call, (py::arg("plate"), py::arg("stiffness")),
			"Add the spring of a soft machine [N/m] behind a plate, along its normal. The loading then prescribes the displacement of the crosshead, the other end of the spring.")
		.def("gaugePoints", After<&GrainSolver::requireGrains, &GrainSolver::gaugePoints>::call, (py::arg("first"), py::arg("second")),
			"Return the nodes nearest to two positions, each on its side of the middle, and their distance [m], for :yref:`Gauge`.")
		.def("sectionNodes", After<&GrainSolver::requireGrains, &GrainSolver::sectionNodes>::call, (py::arg("place"), py::arg("direction"), py::arg("width")),
			"Return the nodes in a band of a width [m] around a position along a direction, a unit vector, and their mean position along it [m], for :yref:`Gauge`.")
		.def("fixTangential", After<&GrainSolver::requirePlane, &GrainSolver::fixTangential>::call, (py::arg("plate")), "Keep the point that a plate touches first from sliding along it, so that a disc does not roll.")
		.def("nodePlaces", After<&GrainSolver::requireGrains, &GrainSolver::nodePlaces>::call, (py::arg("bonded") = false), "Return the nodes available for sets, (n,): all nodes of deformable grains and the centres of rigid grains, and their positions, (n, 2) or (n, 3) [m]. bonded: positions of the bonded state, not the present positions.")
		.def("addNodeSet", After<&GrainSolver::requireGrains, &GrainSolver::addNodeSet>::call, (py::arg("nodes"), py::arg("x") = true, py::arg("y") = true, py::arg("z") = true),
			"Fix nodes of nodePlaces along the named axes, z only in 3D, and return the index of their set.")
		.def("turnNodeSet", After<&GrainSolver::requireGrains, &GrainSolver::turnNodeSet>::call, (py::arg("set"), py::arg("about") = py::object()),
			"Allow a set to rotate about a point [m]. With None, in 2D, it rotates about its mean position and is free to translate, so that only a moment acts.")
		.def("moveNodeSet", After<&GrainSolver::requireGrains, &GrainSolver::moveNodeSet>::call, (py::arg("set"), py::arg("velocity"), py::arg("spin") = Vector3r(Vector3r::Zero())),
			"Move a set from the next step on at a velocity [m/s, or m per step with scaled masses], and rotate it about its position at a spin [rad/s, or rad per step]; in 2D the third component of the velocity is the spin.")
		.def("nodeSets", After<&GrainSolver::requireGrains, &GrainSolver::nodeSets>::call, "Return each node set as a dictionary: nodes, fixed axes, whether it is free to translate (floats), position of its pivot [m], displacement [m], angle [rad], force on the specimen [N], moment about the pivot [N m], work done [J].")
		.def("holdSide", After<&GrainSolver::requireGrains, &GrainSolver::holdSide>::call, (py::arg("side"), py::arg("x") = false, py::arg("y") = false, py::arg("z") = false),
			"Fix a side of the outline along the named axes: nodes of deformable grains; of rigid grains the centres across the side, and the edges or the middles of the faces along it. Sides in 3D: 0 bottom, 1 right or lateral surface, 2 top, 3 left, 4 front, 5 back; front and back along y, before a rig controls the ends, give plane strain of a box.")
		.def("addWall", After<&GrainSolver::requireGrains, &GrainSolver::addWall>::call, (py::arg("position"), py::arg("normal"), py::arg("friction") = 0.),
			"Place a rigid plate at a distance from the specimen, its normal pointing to the specimen, and return its index. The corners of any grain may touch it; in 3D only the corners on the surface. Scale the masses afterwards.")
		.add_property("gravity", After<&GrainSolver::requireGrains, &GrainSolver::gravity>::call, After<&GrainSolver::requireGrains, &GrainSolver::setGravity>::call, "Acceleration of all masses, which must be real [m/s^2]; z only in 3D.")
		.def("plates", After<&GrainSolver::requireGrains, &GrainSolver::plates>::call, "Return each plate as a dictionary: side, normal, width [m], friction [-], whether it is bonded and pressed, position of its face [m], work done [J], displacement [m], velocity [m/s], force on the specimen [N], contact_width [m].")
		.def("mirrorBodies", After<&GrainSolver::requireGrains, &GrainSolver::mirrorBodies>::call, "Update YADE's view of the grains now, independently of mirrorPeriod: states, bonds, forces.")
		.def("resetEnergyBalance", After<&GrainSolver::requireGrains, &GrainSolver::resetEnergyBalance>::call, "Count works and dissipation from now on; the present energy becomes the initial energy. In 3D only before the first step.")
		.def("elasticConstants", After<&GrainSolver::requireGrains, &GrainSolver::elasticConstants>::call, "Return Young's modulus [Pa] and Poisson's ratio [-] of the unloaded specimen from its linear elastic solution: of a rectangle, or of a 3D specimen between smooth ends. The grains do not move.")
		.def("energies", After<&GrainSolver::requireGrains, &GrainSolver::energies>::call, "Return the energies of the last step [J] by name. erased_energy was removed with erased grains and bonds; boundary_work plus initial_energy is the sum of all other energies.")
		.def("snapshot", After<&GrainSolver::requireGrains, &GrainSolver::snapshot>::call, "Return the state as plain arrays by name (see the list of arrays in the documentation): all present grains and bonds, and the record of erased bonds.")
		.def("cracks", After<&GrainSolver::requireGrains, &GrainSolver::cracks>::call, "Return the numbers of cracked points: (tensile, shear). Points of erased bonds do not count as cracked.")
		.def("wallForces", After<&GrainSolver::requirePlane, &GrainSolver::wallForces>::call, (py::arg("grains")), "Return the nodes of other grains on which these grains act, and the forces on them, x and y, at the last step [N], for :yref:`ReleaseController`.")
		.def("parting", After<&GrainSolver::requirePlane, &GrainSolver::parting>::call, "Return the largest increase of the distance between grains that were bonded to each other [m]: of all pairs, and of standing pairs, which have no detached grain. The key for the number of detached grains is ``loose``: grains without a path of contacts to a fixed part and without a pressure.")
		.def("counts", After<&GrainSolver::requireGrains, &GrainSolver::counts>::call, "Return the numbers of grains, particles (the moving bodies: grains or inner particles), contacts between and within grains in the bonded state, new contacts, nodes, triangles or tetrahedra, mesh groups and boundary edges, without erased objects.")
		.def("overlaps", After<&GrainSolver::requireGrains, &GrainSolver::overlaps>::call, (py::arg("smallest") = 1e-3),
			"Return the pairs of grains whose polygons overlap by more than a share of the smaller grain, by name: grains, (n, 2); area of the overlap [m^2]; part, its ratio to the area of the smaller grain [-]; bonded, whether the pair was bonded and is not on a joint; facing, whether a bonded pair still has opposite faces; closed, normal force of the pair divided by its stiffness and the thickness, which is the expected overlap [m^2]. In 3D return the deepest overlap of grains without a common face: depth [m]; of_diameter, its ratio to the mean diameter [-]; grains, the pair; pairs, number of overlapping pairs; clearance, largest part of a depth that no force resists, divided by the mean diameter [-].")
		.def("pairs", After<&GrainSolver::requireSolid, &GrainSolver::pairs>::call, "Return the pairs of near 3D grains without a common face, as arrays by name: grains, (n, 2); contact, number of the contact that the pair replaces, -1: none; force on the second grain, (n, 3) [N]; position of the force, (n, 3) [m]; normal_force [N]; area under pressure [m^2]; depth of overlap beyond the clearance [m]; clearance, depth of overlap without a force [m]; friction_energy, dissipated [J]; elastic_energy [J].")
		.def("unbalanced", After<&GrainSolver::requireGrains, &GrainSolver::unbalanced>::call, "Return the ratio of the largest unbalanced force to the mean contact force [-] at the last measured step. The force on a plate under a load is divided by the number of grains before the plate.")
		.def("crossingSteps", After<&GrainSolver::requireGrains, &GrainSolver::crossingSteps>::call, (py::arg("diameter")), "Return the number of steps of O.dt in which a wave crosses a disc, in 3D a sphere, of grains with a diameter [m] [-].")
		.def("balance", After<&GrainSolver::requireGrains, &GrainSolver::balance>::call,
			"Return the equilibrium of the total specimen at the last step as a dictionary. mean_stress: mean of its Cauchy stress, (xx, yy, xy), tension positive [Pa]; "
			"of rigid grains by the contact forces and branches. outside_stress: the mean stress in equilibrium with pressure, plates, fixed nodes and weight [Pa]. "
			"missing_force: sum of the net forces on all free nodes and grains, (x, y) [N]. plate_share: largest share of the load of a plate that "
			"the specimen does not carry [-]. In a wave the two stresses differ while unbalanced() is small.")
		.def("clearPressure", After<&GrainSolver::requireGrains, &GrainSolver::clearPressure>::call, (py::arg("side")), "Remove the pressure from a side of the outline.")
		.def("sideNodes", After<&GrainSolver::requirePlane, &GrainSolver::sideNodes>::call, (py::arg("side")), "Return the (grain, node) pairs on a side of the outline, (n, 2).")
	);
	// clang-format on
	DECLARE_LOGGER;

private:
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
	void                                diverge(const string& reason);
	void                                mirrorAtStop();
	void                                findStates();
	void                                mirrorStates();
	/// Take out what scripts have erased; of a solid refuse that.
	void removeErased();
	bool isInScene() const;
	bool hasInteraction(int contact) const;
	/// The body of a grain, null if a script has erased it.
	Body* bodyOf(const Scene& world, int grain) const;
	/// The arrays, as shapes and bonds look at them.
	OwnedAssembly own() const;

	vector<shared_ptr<State>>   states; // of the bodies, by slot, of solids by grain; kept alive, so that a body may go at any time
	flexpm::NearPairs           nearPairs;
	vector<flexpm::GrainPair>   candidates;       // near pairs without a contact
	bool                        listed = false;   // the candidates are up to date
	const flexpm::OuterForces*  outer  = nullptr; // of the next step
	mutable vector<std::size_t> places;           // of the contacts among the interactions, when last seen
	void                        requireReady() const;
	void                        takeStep();
	void                        takeSolidStep();
	void                        mirrorPlane();
	void                        mirrorSolid();
	void                        refuseErased();
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
