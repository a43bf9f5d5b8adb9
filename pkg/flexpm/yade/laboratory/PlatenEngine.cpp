// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Platens, confinement and record.
#include <flexpm/yade/laboratory/PlatenEngine.hpp>

#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/laboratory/axial_measures.hpp>
#include <flexpm/kernel/laboratory/end_displacement.hpp>
#include <flexpm/kernel/laboratory/end_rule.hpp>
#include <flexpm/kernel/laboratory/static_preload.hpp>
#include <flexpm/yade/laboratory/PaceEngine.hpp>
#include <flexpm/yade/solver/GrainSolver.hpp>

#include <array>

namespace yade {

YADE_PLUGIN((PlatenEngine)(ConfinementEngine)(AxialRecorder));

namespace {

	flexpm::Sense senseOf(bool tension) { return tension ? flexpm::Sense::tension : flexpm::Sense::compression; }

	struct Column {
		const char* name;
		Real (*value)(const flexpm::AxialObservation&);
	};

	constexpr std::array<Column, 18> recorded { {
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
		{ "friction_energy", [](const auto& o) { return o.energies.friction; } },
		{ "damping_energy", [](const auto& o) { return o.energies.damping; } },
		{ "potential_energy", [](const auto& o) { return o.energies.potential; } },
		{ "boundary_work", [](const auto& o) { return o.energies.boundary_work; } },
		{ "initial_energy", [](const auto& o) { return o.energies.initial; } },
	} };

} // namespace

PlatenEngine::~PlatenEngine() = default;

void PlatenEngine::action()
{
	if (gripped && (!holdTop || velocity == drivenAt)) return;
	auto& assembly = GrainSolver::ofScene(*scene)->assembly;
	if (!gripped) flexpm::grip_bottom(assembly);
	if (!holdTop) return;
	flexpm::move_top(assembly, velocity);
	flexpm::rebook_driven(assembly, scene->dt);
	if (!gripped && elasticStart) flexpm::start_elastically(assembly);
	gripped  = true;
	drivenAt = velocity;
}

void PlatenEngine::lead(Real share, int steps)
{
	const auto world    = Omega::instance().getScene();
	auto&      assembly = GrainSolver::ofScene(*world)->assembly;
	flexpm::grip_bottom(assembly);
	flexpm::move_top(assembly, velocity);
	flexpm::preload(assembly, share, steps, world->dt);
	gripped  = true;
	drivenAt = velocity;
}

void PlatenEngine::goOn()
{
	const auto world = Omega::instance().getScene();
	flexpm::release_preload(GrainSolver::ofScene(*world)->assembly, velocity, world->dt);
}

ConfinementEngine::~ConfinementEngine() = default;

void ConfinementEngine::action()
{
	auto& assembly = GrainSolver::ofScene(*scene)->assembly;
	for (int side : sides)
		flexpm::set_pressure(assembly, side, pressure * flexpm::ramp_factor(assembly.step, rampSteps));
}

AxialRecorder::~AxialRecorder() = default;

void AxialRecorder::action()
{
	const auto solver   = GrainSolver::ofScene(*scene);
	const bool measured = solver->measured();
	if (!measured && !fromNow) return;
	auto now = diameter > 0 ? flexpm::observe_disc(solver->assembly, diameter)
	                        : flexpm::observe(solver->assembly, flexpm::rectangle_of(solver->assembly, senseOf(tension)));
	if (fromNow) zero = Vector2r(now.axial_strain, now.lateral_strain);
	fromNow = false;
	if (!measured) return;
	now.axial_strain -= zero[0];
	now.lateral_strain -= zero[1];
	now.velocity_factor = PaceEngine::ofScene(*scene);
	for (const Column& column : recorded)
		values.push_back(column.value(now));
	peak  = std::max(peak, now.axial_stress);
	state = static_cast<int>(flexpm::test_state(now.axial_stress, peak, now.axial_strain, { stopRatio, leastPeak, maxStrain }));
	if (state != 0) scene->stopAtIter = scene->iter + 1;
}

py::list AxialRecorder::names() const
{
	py::list all;
	for (const Column& column : recorded)
		all.append(column.name);
	return all;
}

py::object AxialRecorder::rows() const { return flexpm_bindings::copied(values, recorded.size()); }

py::dict AxialRecorder::scales() const
{
	const auto world  = Omega::instance().getScene();
	const auto solver = GrainSolver::ofScene(*world);
	const auto sense  = senseOf(tension || diameter > 0);
	const auto inputs = flexpm::scale_inputs(solver->assembly, sense, world->dt);
	const auto size   = diameter > 0 ? flexpm::AxialGeometry() : flexpm::rectangle_of(solver->assembly, sense);
	const auto s      = diameter > 0 ? flexpm::disc_scales(inputs, diameter) : flexpm::rectangle_scales(inputs, size.width, size.height);
	py::dict   d;
	d["crossing_steps"] = s.crossing_steps;
	d["modulus"]        = s.modulus;
	d["strength"]       = s.strength;
	d["height"]         = s.height;
	d["width"]          = s.width;
	return d;
}

} // namespace yade
