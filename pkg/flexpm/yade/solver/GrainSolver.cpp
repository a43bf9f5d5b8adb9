// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  One step and what comes at its periods.
#include <flexpm/yade/solver/GrainSolver.hpp>

#include <flexpm/kernel/assembly/solid_plan.hpp>
#include <flexpm/kernel/assembly/state_check.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/pairs/pair_search.hpp>
#include <flexpm/kernel/parts/node_sets.hpp>
#include <flexpm/kernel/space_lanes/solid_bodies.hpp>
#include <flexpm/kernel/step/solid_masses.hpp>
#include <flexpm/kernel/step/solid_step.hpp>
#include <flexpm/kernel/step/step_plan.hpp>
#include <flexpm/kernel/topology/loose_grains.hpp>
#include <flexpm/yade/grains/LobattoContact.hpp>

#include <mutex>
#include <utility>

namespace yade {

CREATE_LOGGER(GrainSolver);
YADE_PLUGIN((GrainSolver));

GrainSolver::~GrainSolver() = default;

shared_ptr<GrainSolver> GrainSolver::ofScene(const Scene& scene)
{
	for (const auto& engine : scene.engines) {
		const auto solver = YADE_PTR_DYN_CAST<GrainSolver>(engine);
		if (solver && solver->hasGrains()) return solver;
	}
	return YADE_PTR_CAST<GrainSolver>(assemblyOf(scene).engine); // says what is missing
}

void GrainSolver::postLoad(GrainSolver&)
{
	flexpm::check_state(assembly);
	if (hasGrains()) onState([](auto& state) { flexpm::prepare_step(state); });
}

void GrainSolver::preSave(GrainSolver&)
{
	current();
	showNodes();
}

namespace {

	/// A window and scripts may look while an engine does.
	std::mutex looking;

} // namespace

void GrainSolver::showNodes() const
{
	if (!isSolid()) return;
	const std::lock_guard<std::mutex> lock(looking);
	flexpm::show_nodes(const_cast<GrainSolver*>(this)->space);
}

flexpm::SolidState* GrainSolver::placed()
{
	if (!isSolid()) return nullptr;
	const std::lock_guard<std::mutex> lock(looking);
	flexpm::show_places(space);
	return &space;
}

void GrainSolver::takeStep()
{
	forEngines();
	if (assembly.step == 0) flexpm::reset_energy_balance(assembly);
	auto options  = stepOptions();
	options.outer = std::exchange(outer, nullptr);
	flexpm::step(assembly, options);
}

void GrainSolver::takeSolidStep()
{
	try {
		const bool due = stepsDone() % checkPeriod == 0;
		if (flexpm::has_to_search(space, scene->dt) || due) {
			const std::lock_guard<std::mutex> lock(looking);
			flexpm::look_for_pairs(space);
		}
		if (due) flexpm::find_loose(space);
		auto options        = stepOptions();
		options.leave_nodes = true;
		flexpm::step(space, options);
		if (flexpm::bear_pairs(space, massDamping, scaled ? scene->dt : 0.)) limitStep();
	} catch (const std::runtime_error& error) { // of faces that have turned over: the record up to here is good
		diverge(error.what());
		throw;
	}
}

flexpm::StepOptions GrainSolver::stepOptions() const
{
	flexpm::StepOptions options;
	options.dt      = scene->dt;
	options.damping = damping;
	options.threads = threads();
	options.measure = (stepsDone() + 1) % measurePeriod == 0;
	return options;
}

void GrainSolver::action()
{
	requireReady();
	const auto due = [this](int period) { return stepsDone() % period == 0; };
	if (due(checkPeriod)) requireOwnScene();
	if (isSolid()) {
		if (due(checkPeriod) || destroyedContacts() != seenDestroyed) removeErased();
		takeSolidStep();
	} else {
		takeStep();
	}
	if (due(mirrorPeriod)) mirrorStates();
	if (!isSolid()) {
		if (due(touchPeriod)) changeContacts();
		if (due(checkPeriod)) flexpm::find_loose(assembly);
	}
	if (due(checkPeriod)) check();
	if (scene->trackEnergy && measured()) trackEnergies();
	mirrorAtStop();
}

namespace {

	/// A node has used up half of the way that its grain's bound leaves it; what is left is for the steps until the next look.
	bool nearBound(const flexpm::Grains& grains, int grain, const Bound& bound)
	{
		const Real margin = .5 * bound.sweepLength;
		for (int n = 0; n < grains.nodes_of(grain); ++n) {
			const Vector3r p = toYade(grains.position(grains.node(grain, n)));
			for (int axis = 0; axis < grains.layout.dimension; ++axis) {
				if (p[axis] < bound.min[axis] + margin || p[axis] > bound.max[axis] - margin) return true;
			}
		}
		return false;
	}

} // namespace

void GrainSolver::diverge(const string& reason)
{
	diverged   = true;
	stopReason = reason;
}

void GrainSolver::check()
{
	const std::string bad = onState([](const auto& state) { return flexpm::find_bad_number(state); });
	diverged              = false;
	if (!bad.empty()) {
		diverge(bad);
		throw std::runtime_error(getClassName() + ": " + bad);
	}
	removeErased(); // a script that keeps a handle delays its destruction
	findStates();   // a script may have replaced one
	// the collider watches centres only, when NewtonIntegrator runs, which grains do not need
	for (int grain = 0; grain < grainCount(); ++grain) {
		const Body* b = bodyOf(*scene, grain);
		if (b && b->bound && nearBound(grains(), grain, *b->bound)) scene->doSort = true;
	}
}

} // namespace yade
