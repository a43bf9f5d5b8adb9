// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/yade/laboratory/TestFrame.hpp>
#include <flexpm/yade/solver/GrainSolver.hpp>
#include <flexpm/yade/solver/snapshot_dict.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/forces/solid_pressure.hpp>
#include <flexpm/kernel/laboratory/end_displacement.hpp>
#include <flexpm/kernel/laboratory/one_sided_parts.hpp>
#include <flexpm/kernel/laboratory/part_measures.hpp>
#include <flexpm/kernel/laboratory/solid_beam.hpp>
#include <flexpm/kernel/laboratory/solid_frame.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/parts/solid_plates.hpp>
#include <flexpm/kernel/statics/elastic_state.hpp>

namespace yade {

YADE_PLUGIN((TestFrame)(RectangleFrame)(DiscFrame)(PartFrame)(EndFrame)(SolidDiscFrame)(SolidPartFrame));

TestFrame::~TestFrame()           = default;
RectangleFrame::~RectangleFrame() = default;
DiscFrame::~DiscFrame()           = default;
PartFrame::~PartFrame()           = default;
EndFrame::~EndFrame()             = default;
SolidDiscFrame::~SolidDiscFrame() = default;
SolidPartFrame::~SolidPartFrame() = default;

flexpm::TestFrame TestFrame::frame(const flexpm::Assembly&) const
{
	throw std::invalid_argument(
	        "AxialRecorder.frame = TestFrame, must be a RectangleFrame, an EndFrame in 3D, a DiscFrame or a PartFrame; use one of them");
}

flexpm::TestScales TestFrame::scales(const flexpm::Assembly& assembly, Real) const
{
	frame(assembly);
	return {};
}

flexpm::AxialObservation TestFrame::observed(GrainSolver& solver) const
{
	const auto& assembly = solver.forEngines();
	return flexpm::observe(assembly, frame(assembly));
}

flexpm::TestScales TestFrame::scalesOf(GrainSolver& solver, Real dt) const { return scales(solver.assembly, dt); }

namespace {

	py::dict dictOf(const flexpm::ElasticState& found)
	{
		py::list plates, sets;
		for (std::size_t i = 0; i < found.state.plates.size(); ++i) {
			const flexpm::Plate& p = found.state.plates[i];
			plates.append(py::make_tuple(
			        p.force.x, p.force.y, p.displacement.x, p.displacement.y, p.turn.z, flexpm::contact_angle(found.state, static_cast<int>(i))));
		}
		for (const flexpm::NodeSet& s : found.state.node_sets)
			sets.append(py::make_tuple(s.force.x, s.force.y, s.displacement.x, s.displacement.y, s.moment.z));
		py::dict d;
		d["snapshot"]        = flexpm_bindings::snapshot_dict(found.state);
		d["plates"]          = plates;
		d["node_sets"]       = sets;
		d["way"]             = found.way;
		d["load"]            = found.load;
		d["solutions"]       = found.solutions;
		d["beyond_friction"] = found.beyond_friction;
		return d;
	}

	std::optional<double> optional(const py::object& value)
	{
		if (value.is_none()) return {};
		return py::extract<Real>(value)();
	}

	const flexpm::Assembly& present() { return GrainSolver::ofScene(*Omega::instance().getScene())->current(); }

} // namespace

flexpm::TestFrame RectangleFrame::frame(const flexpm::Assembly& assembly) const { return flexpm::rectangle_frame(assembly, sense()); }

flexpm::TestScales RectangleFrame::scales(const flexpm::Assembly& assembly, Real dt) const { return flexpm::rectangle_scales(assembly, sense(), dt); }

std::optional<TestFrame::Measure> RectangleFrame::measure(const string& column, const flexpm::Assembly& assembly, const flexpm::Array<double>& velocity) const
{
	if (column != "lateral_strain") return {};
	return Measure { flexpm::lateral_strain(assembly, sense(), assembly.grains.displacement), flexpm::lateral_strain(assembly, sense(), velocity) };
}

py::dict RectangleFrame::elasticState(bool plates, int pieces, py::object pressure, Real way, py::object load) const
{
	return dictOf(flexpm::find_end_state(present(), { plates, false, tension, pieces, optional(pressure), way, optional(load) }));
}

py::dict DiscFrame::elasticState(bool plates, int pieces, py::object pressure, Real way, py::object load) const
{
	return dictOf(flexpm::find_end_state(present(), { plates, true, false, pieces, optional(pressure), way, optional(load) }));
}

flexpm::TestFrame DiscFrame::frame(const flexpm::Assembly& assembly) const { return flexpm::disc_frame(assembly, diameter); }

flexpm::TestScales DiscFrame::scales(const flexpm::Assembly& assembly, Real dt) const { return flexpm::disc_scales(assembly, diameter, dt); }

flexpm::PartGeometry PartFrame::parts() const { return geometry({ direction[0], direction[1] }, { 0., 0., direction[2] }); }

flexpm::PartGeometry PartFrame::solidParts() const
{
	const flexpm::Vector along = fromYade(direction);
	return turns ? geometry({}, along) : geometry(along, {});
}

py::dict PartFrame::elasticState(vector<int> pressed, vector<Real> pressures, Real way, py::object load) const
{
	if (pressed.size() != pressures.size())
		flexpm::refuse("pressures", Real(pressures.size()), "", "must be one for each plate that is pressed, " + std::to_string(pressed.size()));
	if (GrainSolver::ofScene(*Omega::instance().getScene())->placed()) return solidState(pressed, pressures, way, load);
	flexpm::ElasticLoading asked { {}, driven, drivenSets, backSets, { direction[0], direction[1] }, direction[2], way, {} };
	for (std::size_t i = 0; i < pressed.size(); ++i)
		asked.pressures.emplace_back(pressed[i], pressures[i]);
	asked.load = optional(load);
	try {
		return dictOf(flexpm::find_elastic_state(present(), asked));
	} catch (const std::runtime_error&) {
		flexpm::require_held(present()); // names the motion and a remedy if all of the specimen is free
		throw;
	}
}

flexpm::TestFrame PartFrame::frame(const flexpm::Assembly& assembly) const { return flexpm::part_frame(assembly, parts()); }

flexpm::TestScales PartFrame::scales(const flexpm::Assembly& assembly, Real dt) const { return flexpm::part_scales(assembly, parts(), strength, dt); }

std::optional<TestFrame::Measure> PartFrame::measure(const string& column, const flexpm::Assembly& assembly, const flexpm::Array<double>& velocity) const
{
	if (column != "load") return {};
	return Measure { flexpm::part_load(assembly, parts()), flexpm::part_load_rate(assembly, parts(), velocity) };
}

namespace {

	flexpm::SolidState& solidOf(GrainSolver& solver)
	{
		if (auto* state = solver.placed()) return *state;
		throw std::invalid_argument("AxialRecorder.frame = EndFrame, must be a RectangleFrame, DiscFrame or PartFrame in 2D; use one of them");
	}

} // namespace

flexpm::AxialObservation EndFrame::observed(GrainSolver& solver) const
{
	const auto& state = solidOf(solver);
	return flexpm::observe(state, flexpm::solid_frame(state, sense()));
}

flexpm::TestScales EndFrame::scalesOf(GrainSolver& solver, Real dt) const { return flexpm::solid_scales(solidOf(solver), sense(), dt); }

std::optional<TestFrame::Measure> EndFrame::measure(const string& column, const flexpm::SolidState& solid, const flexpm::Array<double>& velocity) const
{
	if (column != "lateral_strain") return {};
	return Measure { flexpm::lateral_strain(solid, sense()), flexpm::lateral_strain(solid, sense(), velocity) };
}

vector<string> EndFrame::columns() const
{
	if (!twoPressures) return {};
	return { "second_confinement" };
}

vector<Real> EndFrame::values(GrainSolver& solver, Real, Real) const
{
	if (!twoPressures) return {};
	return { flexpm::side_pressures(solidOf(solver)).largest };
}

flexpm::AxialObservation DiscFrame::observed(GrainSolver& solver) const
{
	const auto* state = solver.placed();
	return state ? flexpm::observe(*state, flexpm::solid_disc_frame(*state, diameter, depth)) : TestFrame::observed(solver);
}

flexpm::TestScales DiscFrame::scalesOf(GrainSolver& solver, Real dt) const
{
	const auto* state = solver.placed();
	return state ? flexpm::solid_disc_scales(*state, diameter, depth, dt) : TestFrame::scalesOf(solver, dt);
}

flexpm::AxialObservation PartFrame::observed(GrainSolver& solver) const
{
	const auto* state = solver.placed();
	return state ? flexpm::observe(*state, flexpm::part_frame(*state, solidParts())) : TestFrame::observed(solver);
}

flexpm::TestScales PartFrame::scalesOf(GrainSolver& solver, Real dt) const
{
	const auto* state = solver.placed();
	return state ? flexpm::solid_part_scales(*state, solidParts(), strength, dt) : TestFrame::scalesOf(solver, dt);
}

std::optional<TestFrame::Measure> PartFrame::measure(const string& column, const flexpm::SolidState& solid, const flexpm::Array<double>& velocity) const
{
	if (column == "load") return Measure { flexpm::part_load(solid, solidParts()), flexpm::part_load_rate(solid, solidParts(), velocity) };
	if (column != "cmod") return {};
	const flexpm::Mouth mouth { middle, reach };
	return Measure { flexpm::mouth_opening(solid, mouth), flexpm::mouth_opening(solid, mouth, velocity) };
}

namespace {

	/// The scene's solid, which no step has moved, with plates that are free to move.
	flexpm::SolidState unloaded(const vector<int>& floating)
	{
		flexpm::SolidState state = solidOf(*GrainSolver::ofScene(*Omega::instance().getScene()));
		if (state.step > 0)
			flexpm::refuse(
			        "steps of the scene",
			        Real(state.step),
			        "",
			        "must be 0: the static solution in 3D needs the unloaded specimen; build the specimen again");
		for (int plate : floating)
			flexpm::free_plate(state, plate);
		return state;
	}

	py::dict dictOf(const flexpm::SolidPartState& found)
	{
		const auto append = [](py::list& to, const auto&... vectors) {
			py::list values;
			for (const flexpm::Vector& v : { vectors... }) {
				values.append(v.x);
				values.append(v.y);
				values.append(v.z);
			}
			to.append(values);
		};
		py::list plates, sets;
		for (const flexpm::Plate& p : found.state.plates)
			append(plates, p.force, p.displacement, p.turn);
		for (const flexpm::NodeSet& s : found.state.node_sets)
			append(sets, s.force, s.displacement, s.moment, s.angle);
		py::dict d;
		d["snapshot"]  = GrainSolver::snapshotOf(found.state);
		d["plates"]    = plates;
		d["node_sets"] = sets;
		return d;
	}

} // namespace

py::dict PartFrame::solidState(const vector<int>& pressed, const vector<Real>& pressures, Real way, const py::object& load) const
{
	flexpm::SolidPartLoading asked { {}, way, optional(load) };
	for (std::size_t i = 0; i < pressed.size(); ++i)
		asked.pressures.push_back({ pressed[i], pressures[i] });
	const auto found = flexpm::find_elastic_state(unloaded(pressed), solidParts(), asked, Omega::instance().getScene()->dt);
	py::list   shares;
	for (const flexpm::SolidPartShare& one : found.shares) {
		py::dict share  = dictOf(one.small);
		share["factor"] = one.factor;
		shares.append(share);
	}
	py::dict d;
	d["shares"]    = shares;
	d["way"]       = found.way;
	d["load"]      = found.load;
	d["solutions"] = found.solutions;
	return d;
}

vector<string> PartFrame::columns() const
{
	vector<string> names { "load", "displacement" };
	if (reach > 0) names.push_back("cmod");
	return names;
}

vector<Real> PartFrame::values(GrainSolver& solver, Real stress, Real strain) const
{
	vector<Real> now { stress * area, strain * length };
	if (reach > 0) now.push_back(flexpm::mouth_opening(solidOf(solver), { middle, reach }));
	return now;
}

} // namespace yade
