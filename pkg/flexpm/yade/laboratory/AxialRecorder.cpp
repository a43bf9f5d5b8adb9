// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/yade/laboratory/AxialRecorder.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/laboratory/axial_measures.hpp>
#include <flexpm/kernel/laboratory/loading_motion.hpp>
#include <flexpm/yade/bindings/scales_dict.hpp>
#include <flexpm/yade/solver/GrainSolver.hpp>

#include <array>

namespace yade {

YADE_ENUM(flexpm, TestState, (running)(past_peak)(least_strain_reached)(largest_strain_reached));
YADE_PLUGIN((AxialRecorder));

namespace {

	struct Column {
		const char* name;
		Real (*value)(const flexpm::AxialObservation&);
	};

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

	bool isDisc(const AxialRecorder& recorder)
	{
		flexpm::check_not_negative("AxialRecorder.diameter", recorder.diameter, "m");
		return recorder.diameter > 0;
	}

	flexpm::Sense senseOf(const AxialRecorder& recorder) { return recorder.tension ? flexpm::Sense::tension : flexpm::Sense::compression; }

	/// What the recorder sees of the specimen after a step; the strains count from the bonded state.
	flexpm::AxialObservation observed(const AxialRecorder& recorder, const flexpm::Assembly& assembly)
	{
		auto now = recorder.betweenParts() ? flexpm::observe_parts(assembly, recorder.parts())
		        : isDisc(recorder)         ? flexpm::observe_disc(assembly, recorder.diameter)
		                                   : flexpm::observe(assembly, flexpm::rectangle_of(assembly, senseOf(recorder)));
		if (recorder.loading) now.velocity_factor = recorder.loading->velocityFactor;
		return now;
	}

	/// @throws std::runtime_error  if the record would have a number that is not finite; the test has diverged then
	void requireFinite(const flexpm::AxialObservation& now, GrainSolver& solver)
	{
		const char* bad = flexpm::find_bad_value(now);
		if (!bad) return;
		solver.diverged = true;
		throw std::runtime_error(
		        "AxialRecorder: " + string(bad) + " is not a finite number at step " + std::to_string(now.step)
		        + "; lower the loading rate or check what is driven");
	}

} // namespace

AxialRecorder::~AxialRecorder() = default;

bool AxialRecorder::betweenParts() const { return !driven.empty() || !drivenSets.empty(); }

flexpm::PartGeometry AxialRecorder::parts() const
{
	return { driven, holding, { direction[0], direction[1] }, area, length, drivenSets, backSets, holdingSets, direction[2] };
}

void AxialRecorder::action()
{
	const auto solver = GrainSolver::ofScene(*scene);
	if (!solver->measured()) return;
	auto now = observed(*this, solver->forEngines());
	requireFinite(now, *solver);
	now.axial_strain -= zero[0];
	now.lateral_strain -= zero[1];
	for (const Column& column : recorded)
		values.push_back(column.value(now));
	if (betweenParts()) {
		values.push_back(now.axial_stress * area);
		values.push_back(now.axial_strain * length);
	}
	for (const auto& gauge : gauges)
		values.push_back(gauge->reading(solver->forEngines()));
	if (!controlled.empty()) values.push_back(setPoint);
	stress       = now.axial_stress;
	strain       = now.axial_strain;
	differential = flexpm::differential_stress(now);
	peak         = std::max(peak, differential);
	state        = flexpm::test_state(differential, peak, strain, { stopRatio, leastPeak, minStrain, maxStrain });
	if (state != flexpm::TestState::running) scene->stopAtIter = scene->iter + 1;
}

void AxialRecorder::postLoad(AxialRecorder&)
{
	if (!fromNow) return;
	fromNow              = false;
	const auto& assembly = GrainSolver::ofScene(*Omega::instance().getScene())->current();
	const auto  now      = observed(*this, assembly);
	zero                 = Vector2r(now.axial_strain, now.lateral_strain);
	for (const auto& gauge : gauges)
		gauge->setZero(assembly);
}

py::list AxialRecorder::names() const
{
	py::list all;
	for (const Column& column : recorded)
		all.append(column.name);
	if (betweenParts()) {
		all.append("load");
		all.append("displacement");
	}
	for (const auto& gauge : gauges)
		all.append(gauge->name);
	if (!controlled.empty()) all.append("set_point");
	return all;
}

py::object AxialRecorder::rows() const
{
	const std::size_t columns = recorded.size() + (betweenParts() ? 2 : 0) + gauges.size() + (controlled.empty() ? 0 : 1);
	return flexpm_bindings::copied(values, columns, flexpm_bindings::Access::readOnly);
}

std::pair<Real, Real> AxialRecorder::measure(const string& column, const flexpm::Assembly& assembly) const
{
	const auto field = flexpm::loading_field(assembly);
	for (const auto& gauge : gauges) {
		if (gauge->name == column) return { gauge->reading(assembly), gauge->rate(assembly, field) };
	}
	if (betweenParts() && column == "load") return { flexpm::part_load(assembly, parts()), flexpm::part_load_rate(assembly, parts(), field) };
	if (betweenParts() || isDisc(*this) || column != "lateral_strain")
		throw std::invalid_argument(
		        "AxialRecorder.controlled = " + column + ", must be the name of a gauge, load between parts, or lateral_strain of a rectangle");
	const auto sense = senseOf(*this);
	return { flexpm::lateral_strain(assembly, sense, assembly.grains.displacement) - zero[1], flexpm::lateral_strain(assembly, sense, field) };
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
	const auto& assembly = GrainSolver::ofScene(*Omega::instance().getScene())->current();
	py::list    lost;
	for (const auto& gauge : gauges)
		if (gauge->lost(assembly)) lost.append(gauge->name);
	return lost;
}

void AxialRecorder::addGauge(const shared_ptr<Gauge>& gauge)
{
	if (!gauge) throw std::invalid_argument("AxialRecorder.addGauge: gauge = None, must be a Gauge");
	if (!values.empty()) throw std::runtime_error("AxialRecorder.addGauge: the record has rows, must be empty; add gauges before the first step");
	if (py::extract<bool>(names().contains(gauge->name)))
		throw std::invalid_argument("AxialRecorder.addGauge: name = " + gauge->name + ", must not be that of another column");
	gauges.push_back(gauge);
}

py::dict AxialRecorder::scales() const
{
	const auto  world = Omega::instance().getScene();
	const auto& a     = GrainSolver::ofScene(*world)->assembly;
	if (betweenParts()) return flexpm_bindings::scales_dict(flexpm::part_scales(a, parts(), strength, world->dt));
	const auto sense  = tension || isDisc(*this) ? flexpm::Sense::tension : flexpm::Sense::compression;
	const auto inputs = flexpm::scale_inputs(a, sense, world->dt);
	if (diameter > 0) return flexpm_bindings::scales_dict(flexpm::disc_scales(inputs, diameter));
	const auto size = flexpm::rectangle_of(a, sense);
	return flexpm_bindings::scales_dict(flexpm::rectangle_scales(inputs, size.width, size.height));
}

} // namespace yade
