// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Record of an axial test on grains, and its end, paper Sec. 4.1.
#pragma once

#include <flexpm/kernel/laboratory/axial_measures.hpp>
#include <flexpm/kernel/laboratory/end_rule.hpp>
#include <flexpm/yade/bindings/saved_class.hpp>
#include <flexpm/yade/laboratory/Gauge.hpp>
#include <flexpm/yade/laboratory/LoadingController.hpp>
#include <flexpm/yade/laboratory/TestFrame.hpp>

namespace yade {

class AxialRecorder : public GlobalEngine {
public:
	~AxialRecorder() override;
	void action() override;
	/// YADE calls it after Python has set fromNow, and after a scene is loaded, which has it false.
	void postLoad(AxialRecorder&);

	boost::python::list   names() const;
	boost::python::object rows() const;
	boost::python::dict   scales() const;
	void                  addGauge(const shared_ptr<Gauge>& gauge);
	boost::python::list   gaugeList() const;
	boost::python::list   lostGauges() const;
	Real                  reading(const string& gauge) const;
	/// What a column of the record that a servo may follow reads now, and what it grows by in a second with the motion of the loading.
	/// @throws std::invalid_argument  if it is none
	std::pair<Real, Real> measure(const string& column, GrainSolver& solver) const;

private:
	/// @throws std::invalid_argument  if there is none
	const TestFrame& testFrame() const;
	std::size_t      columnCount() const;
	/// Whether the last rows since plateauFrom are a plateau of the rule.
	bool hasPlateau(const flexpm::TestEnd& rule) const;
	/// What it sees of the specimen after a step; the strains count from the bonded state.
	flexpm::AxialObservation observed(GrainSolver& solver) const;

public:
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(AxialRecorder, GlobalEngine,
		"Records stress, strain, cracks and energies of an axial test at each measured step of :yref:`GrainSolver` (its measurePeriod, "
		"as both must look at the same steps) and stops the simulation when the test is over. Place it after the solver.",
		((shared_ptr<TestFrame>, frame, shared_ptr<TestFrame>(new RectangleFrame),, "Source of load and strains: a :yref:`RectangleFrame`, a :yref:`DiscFrame` or a :yref:`PartFrame`; in 3D an :yref:`EndFrame`, a :yref:`SolidDiscFrame` or a :yref:`SolidPartFrame`."))
		((vector<shared_ptr<Gauge>>, gauges,, Attr::hidden, "Gauges whose readings are additional columns of the record."))
		((shared_ptr<LoadingController>, loading,,, "Loading engine, whose velocity factor is recorded; None: the factor is 1."))
		((string, controlled,,, "Column that a :yref:`ServoController` controls: the name of a gauge, load or lateral_strain; empty: none. Its set point is recorded, too."))
		((Real, setPoint, 0.,, "Present set point of that column [SI unit of the column] |yupdate|."))
		((Real, stopRatio, .5,, "Ratio to the peak below which the stress above the confining pressure ends the test [-]."))
		((Real, leastPeak, 0.,, "Stress above the confining pressure that must be reached before a stress drop ends the test [Pa]."))
		((Real, minStrain, -1e300,, "Axial strain at or below which the test ends [-]."))
		((Real, maxStrain, 1e300,, "Axial strain at or above which the test ends [-]."))
		((Real, plateauStrain, 0.,, "Axial strain over which a stress above the confining pressure that is constant within 2 % ends the test; 0: a plateau does not end it [-]."))
		((int, plateauFrom, 0,, "Index of the first row that may belong to a plateau [-]."))
		((bool, fromNow, false, Attr::triggerPostLoad, "Set it to measure strains and gauge readings from the present state of the scene instead of the bonded state; it is reset to false immediately."))
		((Vector2r, zero, Vector2r::Zero(), Attr::readonly, "Axial and lateral strain that count as zero [-] |yupdate|."))
		((Real, stress, 0., Attr::readonly, "Axial stress of the last row [Pa] |yupdate|."))
		((Real, differential, 0., Attr::readonly, "Axial stress of the last row above the confining pressure [Pa] |yupdate|."))
		((Real, strain, 0., Attr::readonly, "Axial strain of the last row [-] |yupdate|."))
		((Real, peak, 0.,, "Largest stress above the confining pressure until now, the reference of a stress drop [Pa] |yupdate|."))
		((flexpm::TestState, state, flexpm::TestState::running,, "Whether the test is over, and why: running, past_peak, least_strain_reached, largest_strain_reached or plateau_reached. Set it to running to continue |yupdate|."))
		((vector<Real>, values,, Attr::hidden, "The record, row after row [SI units]."))
		, /* ctor */
		, .add_property("names", &AxialRecorder::names, "Names of the columns of the record.")
		.add_property("rows", &AxialRecorder::rows, "The record, (rows, columns); a copy.")
		.add_property("gauges", &AxialRecorder::gaugeList, "Gauges whose readings are recorded; addGauge adds a gauge.")
		.def("addGauge", &AxialRecorder::addGauge, (boost::python::arg("gauge")), "Record the readings of a :yref:`Gauge` in a column with its name; call it before the first row.")
		.def("lostGauges", &AxialRecorder::lostGauges, "Return the names of the gauges with a node of an erased grain.")
		.def("reading", &AxialRecorder::reading, (boost::python::arg("gauge")), "Return the reading of the gauge with this name in the present state, also before the first row [m, -, or the unit of Gauge.reads].")
		.def("scales", &AxialRecorder::scales, "Return the scales of the test by name: crossing_steps, steps of one wave transit [-]; modulus and strength [Pa]; height and width [m]; damage_share, smallest share of a fracture energy that damage dissipates [-]; failure_strain, strain at which a specimen between parts would fail completely [-]; lowest_strength, strength of the weakest contacts [Pa].")
	);
	// clang-format on
};
REGISTER_SAVED(AxialRecorder);

} // namespace yade
