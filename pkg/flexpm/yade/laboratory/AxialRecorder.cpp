// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/yade/laboratory/AxialRecorder.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/laboratory/axial_measures.hpp>
#include <flexpm/kernel/laboratory/loading_motion.hpp>
#include <flexpm/kernel/laboratory/solid_drive.hpp>
#include <flexpm/yade/bindings/scales_dict.hpp>
#include <flexpm/yade/solver/GrainSolver.hpp>

#include <array>

namespace yade {

YADE_ENUM(flexpm, TestState, (running)(past_peak)(least_strain_reached)(largest_strain_reached)(plateau_reached));
YADE_PLUGIN((AxialRecorder));

namespace {

	struct Column {
		const char* name;
		Real (*value)(const flexpm::AxialObservation&);
	};

	/// Indices of columns that the end of a test refers to.
	constexpr std::size_t strainColumn = 1, stressColumn = 3, confinementColumn = 4;

	constexpr std::array<Column, 20> recorded { {
		{ "step", [](const auto& o) { return Real(o.step); } },
		{ "axial_strain", [](const auto& o) { return o.axial_strain; } },
		{ "lateral_strain", [](const auto& o) { return o.lateral_strain; } },
		{ "axial_stress", [](const auto& o) { return o.axial_stress; } },
		{ "confinement", [](const auto& o) { return o.confinement; } },
		{ "tensile_cracks", [](const auto& o) { return Real(o.cracks.tensile); } },
		{ "shear_cracks", [](const auto& o) { return Real(o.cracks.shear); } },
		{ "unbalanced_ratio", [](const auto& o) { return o.unbalanced_ratio; } },
		{ "velocity_factor", [](const auto& o) { return o.velocity_factor; } },
		{ "end_mismatch", [](const auto& o) { return o.end_mismatch; } },
		{ "kinetic_energy", [](const auto& o) { return o.energies.kinetic; } },
		{ "elastic_energy", [](const auto& o) { return o.energies.elastic; } },
		{ "damage_energy", [](const auto& o) { return o.energies.damage; } },
		{ "softened_energy", [](const auto& o) { return o.energies.softened; } },
		{ "friction_energy", [](const auto& o) { return o.energies.friction; } },
		{ "damping_energy", [](const auto& o) { return o.energies.damping; } },
		{ "drag_energy", [](const auto& o) { return o.energies.drag; } },
		{ "potential_energy", [](const auto& o) { return o.energies.potential; } },
		// erasing is done from outside, too: what it takes is negative work
		{ "boundary_work", [](const auto& o) { return o.energies.boundary_work - o.energies.erased; } },
		{ "initial_energy", [](const auto& o) { return o.energies.initial; } },
	} };

	/// @throws std::runtime_error  if the record would have a number that is not finite; the test has diverged then
	void requireFinite(const flexpm::AxialObservation& now, GrainSolver& solver)
	{
		const char* bad = flexpm::find_bad_value(now);
		if (!bad) return;
		solver.diverged = true;
		throw std::runtime_error(
		        "AxialRecorder: " + string(bad) + " is not a finite number at step " + std::to_string(now.step)
		        + "; lower the loading rate or check the driven parts");
	}

} // namespace

AxialRecorder::~AxialRecorder() = default;

const TestFrame& AxialRecorder::testFrame() const
{
	if (!frame) throw std::invalid_argument("AxialRecorder.frame = None, must be a TestFrame; assign the frame of the test");
	return *frame;
}

flexpm::AxialObservation AxialRecorder::observed(GrainSolver& solver) const
{
	auto now = testFrame().observed(solver);
	if (loading) now.velocity_factor = loading->velocityFactor;
	return now;
}

void AxialRecorder::action()
{
	const auto solver = GrainSolver::ofScene(*scene);
	if (!solver->measured()) return;
	auto now = observed(*solver);
	requireFinite(now, *solver);
	now.axial_strain -= zero[0];
	now.lateral_strain -= zero[1];
	for (const Column& column : recorded)
		values.push_back(column.value(now));
	for (Real own : testFrame().values(*solver, now.axial_stress, now.axial_strain))
		values.push_back(own);
	for (const auto& gauge : gauges)
		values.push_back(solver->placed() ? gauge->reading(*solver->placed()) : gauge->reading(solver->forEngines()));
	if (!controlled.empty()) values.push_back(setPoint);
	stress       = now.axial_stress;
	strain       = now.axial_strain;
	differential = flexpm::differential_stress(now);
	peak         = std::max(peak, differential);
	const flexpm::TestEnd rule { stopRatio, leastPeak, minStrain, maxStrain, plateauStrain };
	state = flexpm::test_state(differential, peak, strain, rule, hasPlateau(rule));
	if (state != flexpm::TestState::running) scene->stopAtIter = scene->iter + 1;
}

bool AxialRecorder::hasPlateau(const flexpm::TestEnd& rule) const
{
	const std::size_t columns = columnCount();
	const auto        row     = [&](std::size_t i) {
                const Real* const all = values.data() + i * columns;
                return flexpm::StrainStress { all[strainColumn], all[stressColumn] - all[confinementColumn] };
	};
	return flexpm::is_plateau(row, plateauFrom, values.size() / columns, rule);
}

std::size_t AxialRecorder::columnCount() const { return recorded.size() + testFrame().columns().size() + gauges.size() + (controlled.empty() ? 0 : 1); }

void AxialRecorder::postLoad(AxialRecorder&)
{
	if (!fromNow) return;
	fromNow           = false;
	const auto solver = GrainSolver::ofScene(*Omega::instance().getScene());
	solver->current();
	const auto now = observed(*solver);
	zero           = Vector2r(now.axial_strain, now.lateral_strain);
	for (const auto& gauge : gauges)
		solver->onState([&](const auto& state) { gauge->setZero(state); });
}

py::list AxialRecorder::names() const
{
	py::list all;
	for (const Column& column : recorded)
		all.append(column.name);
	for (const string& own : testFrame().columns())
		all.append(own);
	for (const auto& gauge : gauges)
		all.append(gauge->name);
	if (!controlled.empty()) all.append("set_point");
	return all;
}

py::object AxialRecorder::rows() const { return flexpm_bindings::copied(values, columnCount(), flexpm_bindings::Access::readOnly); }

std::pair<Real, Real> AxialRecorder::measure(const string& column, GrainSolver& solver) const
{
	const auto ofState = [&](const auto& state) -> std::pair<Real, Real> {
		const auto field = flexpm::loading_field(state);
		for (const auto& gauge : gauges) {
			if (gauge->name == column) return { gauge->reading(state), gauge->rate(state, field) };
		}
		auto own = testFrame().measure(column, state, field);
		if (!own)
			throw std::invalid_argument(
			        "AxialRecorder.controlled = " + column
			        + ", must be the name of a gauge, load between parts in 2D, cmod in 3D, or lateral_strain between ends; choose one of them");
		if (column == "lateral_strain") own->first -= zero[1];
		return *own;
	};
	return solver.placed() ? ofState(*solver.placed()) : ofState(solver.forEngines());
}

py::list AxialRecorder::gaugeList() const
{
	py::list all;
	for (const auto& gauge : gauges)
		all.append(gauge);
	return all;
}

py::list AxialRecorder::lostGauges() const
{
	const auto solver = GrainSolver::ofScene(*Omega::instance().getScene());
	py::list   lost;
	if (solver->placed()) return lost; // a solid keeps its grains
	const auto& assembly = solver->current();
	for (const auto& gauge : gauges)
		if (gauge->lost(assembly.grains)) lost.append(gauge->name);
	return lost;
}

Real AxialRecorder::reading(const string& name) const
{
	const auto solver = GrainSolver::ofScene(*Omega::instance().getScene());
	for (const auto& gauge : gauges)
		if (gauge->name == name) return solver->placed() ? gauge->reading(*solver->placed()) : gauge->reading(solver->current());
	throw std::invalid_argument("AxialRecorder.reading: gauge = " + name + ", must be the name of a gauge; add it with addGauge");
}

void AxialRecorder::addGauge(const shared_ptr<Gauge>& gauge)
{
	if (!gauge) throw std::invalid_argument("AxialRecorder.addGauge: gauge = None, must be a Gauge");
	if (!values.empty()) throw std::runtime_error("AxialRecorder.addGauge: the record has rows, must be empty; add gauges before the first step");
	if (py::extract<bool>(names().contains(gauge->name)))
		throw std::invalid_argument("AxialRecorder.addGauge: name = " + gauge->name + ", must not be the name of another column; choose another name");
	gauges.push_back(gauge);
}

py::dict AxialRecorder::scales() const
{
	const auto world = Omega::instance().getScene();
	return flexpm_bindings::scales_dict(testFrame().scalesOf(*GrainSolver::ofScene(*world), world->dt));
}

} // namespace yade
