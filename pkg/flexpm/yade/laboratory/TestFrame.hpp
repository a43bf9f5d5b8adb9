// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  What tells a record where load and strains of its test come from: one class for each outline and way to hold it,
/// paper Sec. 4.1.
#pragma once

#include <flexpm/kernel/laboratory/axial_measures.hpp>
#include <flexpm/kernel/laboratory/part_measures.hpp>
#include <flexpm/kernel/laboratory/solid_parts.hpp>
#include <flexpm/yade/abi/yade_lite.hpp>
#include <flexpm/yade/bindings/saved_class.hpp>

#include <optional>

namespace yade {

class GrainSolver;

class TestFrame : public Serializable {
public:
	/// What a measure reads, and what it grows by in a second with the motion of the loading.
	using Measure = std::pair<Real, Real>;

	~TestFrame() override;
	/// The kernel's frame; by itself the class has none.
	virtual flexpm::TestFrame  frame(const flexpm::Assembly& assembly) const;
	virtual flexpm::TestScales scales(const flexpm::Assembly& assembly, Real dt) const;
	/// What is seen of a solver's grains after a step, and the scales of their test.
	virtual flexpm::AxialObservation observed(GrainSolver& solver) const;
	virtual flexpm::TestScales       scalesOf(GrainSolver& solver, Real dt) const;
	/// Names of the columns that a record has because of it.
	virtual vector<string> columns() const { return {}; }
	/// Their values, of the record's stress and strain.
	virtual vector<Real> values(GrainSolver&, Real, Real) const { return {}; }
	/// A measure of its own that a servo may follow, where nodes move so; none of that name.
	virtual std::optional<Measure> measure(const string&, const flexpm::Assembly&, const flexpm::Array<double>&) const { return {}; }
	virtual std::optional<Measure> measure(const string&, const flexpm::SolidState&, const flexpm::Array<double>&) const { return {}; }

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(TestFrame, Serializable,
		"Base of the sources of load and strains of an :yref:`AxialRecorder`. Not to be used directly.",
	);
	// clang-format on
};
REGISTER_SAVED(TestFrame);

class RectangleFrame : public TestFrame {
public:
	~RectangleFrame() override;
	flexpm::TestFrame      frame(const flexpm::Assembly& assembly) const override;
	flexpm::TestScales     scales(const flexpm::Assembly& assembly, Real dt) const override;
	std::optional<Measure> measure(const string& column, const flexpm::Assembly& assembly, const flexpm::Array<double>& velocity) const override;
	boost::python::dict    elasticState(bool plates, int pieces, boost::python::object pressure, Real way, boost::python::object load) const;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(RectangleFrame, TestFrame,
		"A rectangle between its bottom and its top.",
		((bool, tension, false,, "Stress and strain count positive in tension instead of compression."))
		, /* ctor */
		, .def("elasticState", &RectangleFrame::elasticState, (boost::python::arg("plates"), boost::python::arg("pieces"), boost::python::arg("pressure"), boost::python::arg("way"), boost::python::arg("load")),
			"Compute the state of equilibrium of the scene's specimen between its ends, provided that no further contact breaks. plates: the ends are plates, not nodes; pieces: plates on each side; pressure on the sides, and on a top that is not driven [Pa] (None: the present pressures); way: displacement of the top [m]; load on the top [N] (None: only the displacement is prescribed). Returns the same dictionary as PartFrame.elasticState.")
	);
	// clang-format on

private:
	flexpm::Sense sense() const { return tension ? flexpm::Sense::tension : flexpm::Sense::compression; }
};
REGISTER_SAVED(RectangleFrame);

class DiscFrame : public TestFrame {
public:
	~DiscFrame() override;
	flexpm::TestFrame        frame(const flexpm::Assembly& assembly) const override;
	flexpm::TestScales       scales(const flexpm::Assembly& assembly, Real dt) const override;
	flexpm::AxialObservation observed(GrainSolver& solver) const override;
	flexpm::TestScales       scalesOf(GrainSolver& solver, Real dt) const override;
	boost::python::dict      elasticState(bool plates, int pieces, boost::python::object pressure, Real way, boost::python::object load) const;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(DiscFrame, TestFrame,
		"A disc between a lower and an upper plate, the first two of :yref:`GrainSolver`; in 3D its axis is y, and :yref:`GrainSolver.holdDisc` places the plates.",
		((Real, diameter, 0.,, "Diameter of the disc [m]."))
		((Real, depth, 0.,, "Depth of the disc in 3D, along y [m]."))
		, /* ctor */
		, .def("elasticState", &DiscFrame::elasticState, (boost::python::arg("plates"), boost::python::arg("pieces"), boost::python::arg("pressure"), boost::python::arg("way"), boost::python::arg("load")),
			"Compute the state of equilibrium as RectangleFrame.elasticState does, between two plates and without a pressure; only in 2D.")
	);
	// clang-format on
};
REGISTER_SAVED(DiscFrame);

class PartFrame : public TestFrame {
public:
	~PartFrame() override;
	flexpm::TestFrame        frame(const flexpm::Assembly& assembly) const override;
	flexpm::TestScales       scales(const flexpm::Assembly& assembly, Real dt) const override;
	flexpm::AxialObservation observed(GrainSolver& solver) const override;
	flexpm::TestScales       scalesOf(GrainSolver& solver, Real dt) const override;
	vector<string>           columns() const override;
	vector<Real>             values(GrainSolver& solver, Real stress, Real strain) const override;
	std::optional<Measure>   measure(const string& column, const flexpm::Assembly& assembly, const flexpm::Array<double>& velocity) const override;
	std::optional<Measure>   measure(const string& column, const flexpm::SolidState& solid, const flexpm::Array<double>& velocity) const override;
	boost::python::dict      elasticState(vector<int> pressed, vector<Real> pressures, Real way, boost::python::object load) const;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(PartFrame, TestFrame,
		"Plates and node sets that fix and load a specimen of any outline, by their indices in :yref:`GrainSolver`.",
		((vector<int>, driven,,, "Plates that load the specimen [-]."))
		((vector<int>, holding,,, "Plates that resist the load [-]."))
		((vector<int>, drivenSets,,, "Node sets that load the specimen [-]."))
		((vector<int>, backSets,,, "Node sets that rotate in the opposite sense [-]."))
		((vector<int>, holdingSets,,, "Node sets that resist the load [-]."))
		((Vector3r, direction, Vector3r::Zero(),, "Direction in which the driven parts load, a unit vector; in 2D z = 1: node sets rotate, and the load is the sum of their moments [N m], the displacement their angle [rad] [-]."))
		((bool, turns, false,, "In 3D: node sets rotate about the direction."))
		((Real, area, 0.,, "Ratio of the load to the recorded stress [m2]."))
		((Real, length, 0.,, "Ratio of the displacement to the recorded strain [m]."))
		((Real, strength, 0.,, "Estimate of the stress at the peak [Pa]."))
		((Real, middle, 0.,, "In 3D: x of the middle of the bottom, where a notch opens [m]."))
		((Real, reach, 0.,, "In 3D: distance from there to each of the two lines whose separation is the column cmod [m]; 0: no such column."))
		((vector<Real>, loadingScales,,, "Scales of the specimen before the loading, in the order of AxialRecorder.scales(); empty until the loading begins. A broken specimen would have other scales."))
		, /* ctor */
		, .def("elasticState", &PartFrame::elasticState, (boost::python::arg("pressed"), boost::python::arg("pressures"), boost::python::arg("way"), boost::python::arg("load")),
			"Compute the state of equilibrium of the scene's specimen, provided that no further contact breaks. pressed, pressures: plates and the pressures on them [Pa], in addition to the present pressures; way: displacement of the driven parts [m], or the angle of rotating sets [rad]; load on the driven parts [N], or the moment on rotating sets [N m] (None: only the displacement is prescribed). The scene does not change. Returns the state as in GrainSolver.snapshot(), forces and displacements of plates and node sets, way, load, the number of solutions, and the sticking points beyond their friction. In 3D the specimen must be unloaded. The result is then a list of shares, small states: each change from the unloaded state, times factor, is a part of the total change. It also has way, load and the number of solutions.")
	);
	// clang-format on

private:
	flexpm::PartGeometry parts() const;
	flexpm::PartGeometry solidParts() const;
	boost::python::dict  solidState(const vector<int>& pressed, const vector<Real>& pressures, Real way, const boost::python::object& load) const;
	flexpm::PartGeometry geometry(flexpm::Vector along, flexpm::Vector turn) const
	{
		return { driven, holding, along, area, length, drivenSets, backSets, holdingSets, turn };
	}
};
REGISTER_SAVED(PartFrame);

class EndFrame : public TestFrame {
public:
	~EndFrame() override;
	flexpm::AxialObservation observed(GrainSolver& solver) const override;
	flexpm::TestScales       scalesOf(GrainSolver& solver, Real dt) const override;
	std::optional<Measure>   measure(const string& column, const flexpm::SolidState& solid, const flexpm::Array<double>& velocity) const override;
	vector<string>           columns() const override;
	vector<Real>             values(GrainSolver& solver, Real stress, Real strain) const override;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(EndFrame, TestFrame,
		"A 3D specimen between its ends, along z.",
		((bool, tension, false,, "Stress and strain count positive in tension instead of compression."))
		((bool, twoPressures, false,, "A box has different pressures across x and y. The column second_confinement has the larger pressure [Pa]."))
	);
	// clang-format on

private:
	flexpm::Sense sense() const { return tension ? flexpm::Sense::tension : flexpm::Sense::compression; }
};
REGISTER_SAVED(EndFrame);

class SolidDiscFrame : public DiscFrame {
public:
	~SolidDiscFrame() override;

	YADE_CLASS_BASE_DOC(SolidDiscFrame, DiscFrame, "Name of the 3D :yref:`DiscFrame` until version 0.4.");
};
REGISTER_SAVED(SolidDiscFrame);

class SolidPartFrame : public PartFrame {
public:
	~SolidPartFrame() override;

	YADE_CLASS_BASE_DOC(SolidPartFrame, PartFrame, "Name of the 3D :yref:`PartFrame` until version 0.4.");
};
REGISTER_SAVED(SolidPartFrame);

} // namespace yade
