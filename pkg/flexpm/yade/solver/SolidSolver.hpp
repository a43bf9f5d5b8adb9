// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The same engine for polyhedral grains in space: what it steps is a state of its own.
#pragma once

#include <flexpm/kernel/space/polyhedra.hpp>
#include <flexpm/kernel/space/solid.hpp>
#include <flexpm/yade/bindings/assembly_archive.hpp>
#include <flexpm/yade/solver/GrainSolver.hpp>

namespace yade {

class SolidSolver : public GrainSolver {
public:
	~SolidSolver() override;
	void action() override;
	/// YADE calls it after it has loaded a scene or set attributes by name.
	void postLoad(SolidSolver&);

	flexpm::SolidState* solid() override { return &state; }
	bool                hasGrains() const override { return state.grains.count > 0; }
	long                stepsDone() const override { return state.step; }
	bool                holds(int place) const override;

	void assembleSolid(const flexpm::Polyhedra& cells, const flexpm::Solid& outline, py::list materials, py::list pairs, vector<int> minerals, bool rigid);
	void scaleMasses();
	void holdEnds(bool bonded, Real friction);
	void holdBottom(bool plate);
	void holdDisc(Real jawRadius);
	int  layLine(int side, Real x, Real z, Real width, bool pinned);
	int  findLine(int side, Real x, Real z, Real width, bool pinned);
	int  layPatch(Vector3r normal, Vector3r low, Vector3r high, Real friction, bool bonded, Real strip, bool seated);
	int  findPatch(Vector3r normal, Vector3r low, Vector3r high, Real friction, bool bonded, Real strip, bool seated);
	int  layJaw(Vector3r towards, Real ratio, Real angle, Real friction, Real strip);
	int  findJaw(Vector3r towards, Real ratio, Real angle, Real friction, Real strip);
	void freePlate(int plate);
	void setMachine(int plate, Real stiffness);
	py::tuple gaugePoints(Vector3r first, Vector3r second);
	py::list  plates();
	py::tuple nodePlaces(bool bonded);
	int       addNodeSet(vector<int> nodes, bool x, bool y, bool z);
	void      turnNodeSet(int set, py::object about);
	void      moveNodeSet(int set, Vector3r velocity, Vector3r spin);
	py::list  nodeSets();
	py::tuple elasticConstants();
	void      clearPressure(int side);
	void      holdSide(int side, bool x, bool y, bool z);
	Real      useRealMasses();
	void      resetEnergyBalance();
	py::tuple sectionNodes(Real place, Vector3r direction, Real width);
	py::dict  snapshot();
	/// The same of any state.
	static py::dict snapshotOf(const flexpm::SolidState& state);
	py::dict        counts();
	py::dict        overlaps();
	Real            crossingSteps(Real diameter);

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(SolidSolver, GrainSolver,
		"Advances polyhedral grains in space as :yref:`GrainSolver` does those of the plane: points of faces, tetrahedra, nodes. What it has "
		"of that engine are its attributes, bodies and bonds in the scene, energies(), cracks(), unbalanced() and the methods below; others refuse a solid. "
		"A solid keeps its grains and bonds: a step refuses a scene from which a script has erased any.",
		((flexpm::SolidState, state,, Attr::hidden, "The packed arrays: the one home of the grains' state."))
		, /* ctor */
		, .def("assembleSolid", &SolidSolver::assembleSolid, (py::arg("cells"), py::arg("outline"), py::arg("materials"), py::arg("pairs") = py::list(), py::arg("minerals") = vector<int>(), py::arg("rigid") = false),
			"Build the bonded, unloaded grains, once; flexpm.build calls it. materials: those of the minerals; pairs: of contacts of minerals i and j, at i times their number plus j; minerals: that of each cell.")
		.def("scaleMasses", WithGrains<&SolidSolver::scaleMasses>::call, "Scale the masses for a step of O.dt with the present damping, Sec. 2.4.")
		.def("holdEnds", WithGrains<&SolidSolver::holdEnds>::call, (py::arg("bonded") = false, py::arg("friction") = 0.),
			"Take hold of the bottom and the top along z, which stay free across: of their nodes, or of rigid grains by plates, which pull as well if they are bonded. With a friction above 0 [-] by plates of any grains, to which they stick from now on as far as it bears. Scale the masses afterwards.")
		.def("holdBottom", WithGrains<&SolidSolver::holdBottom>::call, (py::arg("plate") = false), "Take hold of the bottom alone in the same way, if it is not held, and of a place on it across; the top may bear a pressure meanwhile. plate: by a plate of any grains.")
		.def("holdDisc", WithGrains<&SolidSolver::holdDisc>::call, (py::arg("jawRadius") = 0.), "Lay a smooth plate below a disc and one on top, which touch it, or jaws of a radius [m]. What they touch at first does not move along x, and one place of it not along y, else the disc would roll. Scale the masses afterwards.")
		.def("layLine", WithGrains<&SolidSolver::layLine>::call, (py::arg("side"), py::arg("x"), py::arg("z"), py::arg("width"), py::arg("pinned") = false),
			"Lay a plate that bears along a line across the depth, along y at x and z, with the stiffness of a strip of that width [m]: a roller on the bottom (side 0) or a head on top (2). pinned: it does not slide while it presses. Returns its number. Scale the masses afterwards.")
		.def("findLine", WithGrains<&SolidSolver::findLine>::call, (py::arg("side"), py::arg("x"), py::arg("z"), py::arg("width"), py::arg("pinned") = false), "Number of the plate that layLine has laid so; -1 without one.")
		.def("layPatch", WithGrains<&SolidSolver::layPatch>::call, (py::arg("normal"), py::arg("low"), py::arg("high"), py::arg("friction") = 0., py::arg("bonded") = false, py::arg("strip") = 0., py::arg("seated") = false),
			"Lay a plate against what lies of the outside in a box from low to high [m] and faces a normal, a unit vector that points into the specimen. friction: coefficient [-]; bonded: it pulls, too; strip: stiffness per area of a soft layer between, in series [Pa/m]; seated: it turns about the middle of its face, as on a spherical seat. Returns its number. Scale the masses afterwards.")
		.def("findPatch", WithGrains<&SolidSolver::findPatch>::call, (py::arg("normal"), py::arg("low"), py::arg("high"), py::arg("friction") = 0., py::arg("bonded") = false, py::arg("strip") = 0., py::arg("seated") = false), "Number of the plate that layPatch has laid so; -1 without one.")
		.def("layJaw", WithGrains<&SolidSolver::layJaw>::call, (py::arg("towards"), py::arg("ratio"), py::arg("angle"), py::arg("friction") = 0., py::arg("strip") = 0.),
			"Lay a curved jaw against the mantle of a disc about the y axis, in a direction from that axis, before an angle of it [rad]. ratio: of its radius over the disc's, at least 1; friction: coefficient [-]; strip: as of layPatch. Returns its number. Scale the masses afterwards.")
		.def("findJaw", WithGrains<&SolidSolver::findJaw>::call, (py::arg("towards"), py::arg("ratio"), py::arg("angle"), py::arg("friction") = 0., py::arg("strip") = 0.), "Number of the plate that layJaw has laid so; -1 without one.")
		.def("freePlate", WithGrains<&SolidSolver::freePlate>::call, (py::arg("plate")), "Let a load move a plate along its normal, for :yref:`PressureController`; it stands until then. Scale the masses afterwards.")
		.def("setMachine", WithGrains<&SolidSolver::setMachine>::call, (py::arg("plate"), py::arg("stiffness")), "Lay the spring of a soft machine [N/m] behind a plate, along its normal. What drives the plate then drives its crosshead; a jaw must be smooth.")
		.def("gaugePoints", WithGrains<&SolidSolver::gaugePoints>::call, (py::arg("first"), py::arg("second")),
			"The nodes nearest to two places, each on its own side of the middle, and their distance [m], for :yref:`Gauge`.")
		.def("elasticConstants", WithGrains<&SolidSolver::elasticConstants>::call, "Young's modulus [Pa] and Poisson's ratio of the unloaded grains between smooth ends, by their linear solution; they stay as they are.")
		.def("clearPressure", WithGrains<&SolidSolver::clearPressure>::call, (py::arg("side")), "Take the pressure off a side.")
		.def("balance", WithGrains<&GrainSolver::balance>::call,
			"How far the specimen is in balance at the last step, by name: mean_stress and outside_stress [Pa], each (xx, yy, zz, yz, xz, xy), missing_force [N], plate_share, 0.")
		.def("holdSide", WithGrains<&SolidSolver::holdSide>::call, (py::arg("side"), py::arg("x") = false, py::arg("y") = false, py::arg("z") = false),
			"Hold the nodes of deformable grains on a side along the axes named, of rigid ones the centres behind it across it and the middles of their faces along it. Sides: 0 bottom, 1 right or mantle, 2 top, 3 left, 4 front, 5 back; front and back along y, before a rig takes the ends: plane strain of a box.")
		.def("useRealMasses", WithGrains<&SolidSolver::useRealMasses>::call, "Use the real masses; returns the stable time step [s].")
		.def("resetEnergyBalance", WithGrains<&SolidSolver::resetEnergyBalance>::call, "Let the balance of energies begin with the present velocities, before the first step.")
		.def("sectionNodes", WithGrains<&SolidSolver::sectionNodes>::call, (py::arg("place"), py::arg("direction"), py::arg("width")),
			"Nodes of a gauge that reads the mean way of a section: those in a band of a width across a unit vector, about a place along it [m]; and where they lie along it in the mean.")
		.def("snapshot", WithGrains<&SolidSolver::snapshot>::call, "The state as plain arrays, by name.")
		.def("counts", WithGrains<&SolidSolver::counts>::call, "Numbers of grains, contacts as bonded, nodes and tetrahedra.")
		.def("overlaps", WithGrains<&SolidSolver::overlaps>::call, "The deepest overlap of grains that share no contact, which nothing keeps apart, as a dictionary: depth [m], of_diameter, over the mean diameter [-], grains, a pair, and pairs, how many overlap.")
		.def("crossingSteps", WithGrains<&SolidSolver::crossingSteps>::call, (py::arg("diameter")), "Steps of O.dt in which a wave crosses a ball of the grains of a diameter [m] [-].")
		.def("plates", WithGrains<&SolidSolver::plates>::call, "All plates as dictionaries: what they are, where, and what they bear at the last step; those on ends, too.")
		.def("nodePlaces", WithGrains<&SolidSolver::nodePlaces>::call, (py::arg("bonded") = false), "Nodes that a set may hold, all of deformable grains and the centres of rigid ones, and their x, y and z, now or when bonded [m].")
		.def("addNodeSet", WithGrains<&SolidSolver::addNodeSet>::call, (py::arg("nodes"), py::arg("x") = true, py::arg("y") = true, py::arg("z") = true), "Hold nodes at rest along the axes named; returns the number of the set.")
		.def("turnNodeSet", WithGrains<&SolidSolver::turnNodeSet>::call, (py::arg("set"), py::arg("about")), "Let a node set turn about a place [m].")
		.def("moveNodeSet", WithGrains<&SolidSolver::moveNodeSet>::call, (py::arg("set"), py::arg("velocity"), py::arg("spin") = Vector3r(Vector3r::Zero())), "Let a node set move from the next step on [m/s, or m per step], and turn about its place [rad/s, or rad per step].")
		.def("nodeSets", WithGrains<&SolidSolver::nodeSets>::call, "All node sets as dictionaries: what they hold, where, and what they bear at the last step.")
	);
	// clang-format on

private:
	void requireReady() const;
	void takeStep();
	void findStates() override;
	void mirrorStates() override;
	void removeErased() override;
};
REGISTER_SAVED(SolidSolver);

} // namespace yade
