// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Platens of a test on deformable grains: held and driven boundary nodes, pressed sides, and the record, paper Sec. 4.1.
#pragma once

#include <flexpm/yade/abi/yade_lite.hpp>

namespace yade {

class PlatenEngine : public GlobalEngine {
public:
	~PlatenEngine() override;
	void action() override;
	void lead(Real share, int steps);
	void goOn();

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(PlatenEngine, GlobalEngine,
		"Holds the bottom nodes of a rectangular specimen axially (one of them also laterally) and moves the top nodes; "
		"no friction on either. Place it before :yref:`GrainSolver`.",
		((Real, velocity, 0.,, "Velocity of the top, positive away from the bottom [m/s, or m per step with scaled masses]."))
		((bool, holdTop, true,, "Drive the top; if not, only the bottom is held and the top is free."))
		((bool, elasticStart, true,, "Start all nodes with the velocities of the elastic solution, so that no wave runs through the specimen."))
		((bool, gripped, false, Attr::readonly, "The top has been taken hold of."))
		((Real, drivenAt, 0., Attr::hidden, "Velocity that the top's nodes have."))
		, /* ctor */
		, .def("lead", &PlatenEngine::lead, (boost::python::arg("share"), boost::python::arg("steps")),
			"Take hold of all nodes of the unloaded specimen: that many steps lead it along its elastic solution to this share of the strain at which the first contact point leaves its elastic branch.")
		.def("goOn", &PlatenEngine::goOn, "Set the nodes free again after those steps.")
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(PlatenEngine);

class ConfinementEngine : public GlobalEngine {
public:
	~ConfinementEngine() override;
	void action() override;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(ConfinementEngine, GlobalEngine,
		"Presses on sides of the specimen; the pressure follows the deforming edges. Place it before :yref:`GrainSolver`.",
		((Real, pressure, 0.,, "Pressure, compressive positive [Pa]."))
		((vector<int>, sides, (vector<int> { 1, 3 }),, "Sides of the outline; of a rectangle 0 bottom, 1 right, 2 top, 3 left."))
		((int, rampSteps, 0,, "Steps over which the pressure rises evenly to its value [-]."))
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(ConfinementEngine);

class AxialRecorder : public GlobalEngine {
public:
	~AxialRecorder() override;
	void action() override;

	boost::python::list   names() const;
	boost::python::object rows() const;
	boost::python::dict   scales() const;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(AxialRecorder, GlobalEngine,
		"Records stress, strain, cracks and energies of an axial test at each measured step of :yref:`GrainSolver` and stops the "
		"simulation when the test is over. Place it after the solver.",
		((Real, diameter, 0.,, "Of a disc between a lower and an upper plate; 0: the specimen is a rectangle [m]."))
		((bool, tension, false,, "Stress and strain count positive in tension instead of compression."))
		((Real, stopRatio, .5,, "The test is over once the stress has fallen below this part of its peak [-]."))
		((Real, leastPeak, 0.,, "No fall counts before the stress has reached this [Pa]."))
		((Real, maxStrain, 1e300,, "The test is over at this axial strain [-]."))
		((bool, fromNow, false,, "Count strains from the next step on instead of from the bonded state; false after that step."))
		((Vector2r, zero, Vector2r::Zero(), Attr::readonly, "Axial and lateral strain that count as zero [-]."))
		((Real, peak, 0., Attr::readonly, "Largest axial stress so far [Pa]."))
		((int, state, 0, Attr::readonly, "0 running, 1 past the peak, 2 largest strain reached."))
		((vector<Real>, values,, Attr::hidden, "The record, row after row."))
		, /* ctor */
		, .add_property("names", &AxialRecorder::names, "Names of the record's columns.")
		.add_property("rows", &AxialRecorder::rows, "The record, (rows, columns); a copy.")
		.def("scales", &AxialRecorder::scales, "Scales of the test by name: crossing_steps [-], modulus and strength [Pa], height and width [m].")
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(AxialRecorder);

} // namespace yade
