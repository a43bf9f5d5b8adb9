// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  One step, and what YADE's objects see of it.
#include <flexpm/yade/GrainSolver.hpp>

#include <flexpm/kernel/measures.hpp>
#include <flexpm/kernel/rigid_grain.hpp>
#include <flexpm/kernel/stepping.hpp>
#include <flexpm/yade/LobattoContact.hpp>

#include <algorithm>

#include <omp.h>

namespace yade {

CREATE_LOGGER(GrainSolver);
YADE_PLUGIN((GrainSolver));

GrainSolver::~GrainSolver() = default;

shared_ptr<GrainSolver> GrainSolver::ofScene(const Scene& scene)
{
	for (const auto& engine : scene.engines) {
		if (auto solver = YADE_PTR_DYN_CAST<GrainSolver>(engine)) return solver;
	}
	throw std::runtime_error("GrainSolver: O.engines holds none; build the specimen first (flexpm.build)");
}

shared_ptr<GrainSolver> GrainSolver::ofGrain(int grain)
{
	const auto solver = ofScene(*Omega::instance().getScene());
	if (grain >= 0 && grain < solver->assembly.grains) return solver;
	throw std::runtime_error("LaguerreCell.grain = " + std::to_string(grain) + ", is no grain of the solver; build the specimen first (flexpm.build)");
}

shared_ptr<GrainSolver> GrainSolver::ofContact(int contact)
{
	const auto solver = ofScene(*Omega::instance().getScene());
	if (contact >= 0 && contact < solver->assembly.contacts) return solver;
	throw std::runtime_error("contact = " + std::to_string(contact) + ", is no contact of the solver; build the specimen first (flexpm.build)");
}

void GrainSolver::action()
{
	if (destroyedContacts() != seenDestroyed) retireErased();
	if (assembly.step == 0) flexpm::open_books(assembly);
	flexpm::StepOptions options;
	options.dt      = scene->dt;
	options.damping = damping;
	options.threads = ompThreads > 0 ? ompThreads : omp_get_max_threads();
	options.measure = (assembly.step + 1) % measurePeriod == 0;
	flexpm::step(assembly, options);
	publishBodies();
	if (assembly.step % touchPeriod == 0) changeContacts();
	if (options.measure) check();
}

namespace {

	/// A node has used up half of the way that its grain's bound leaves it; what is left is for the steps until the next look.
	bool nearBound(const flexpm::Assembly& a, int grain, const Bound& bound)
	{
		const Real margin = .5 * bound.sweepLength;
		for (int n = 0; n < a.nodes_of(grain); ++n) {
			const auto p = a.position(a.node(grain, n));
			if (p.x < bound.min[0] + margin || p.x > bound.max[0] - margin || p.y < bound.min[1] + margin || p.y > bound.max[1] - margin)
				return true;
		}
		return false;
	}

} // namespace

void GrainSolver::check()
{
	const std::string bad = flexpm::find_bad_number(assembly);
	if (!bad.empty()) throw std::runtime_error("GrainSolver: " + bad);
	retireErased(); // a script that keeps a handle delays its destruction
	// the collider watches centres only, when NewtonIntegrator runs, which grains do not need
	for (int grain = 0; grain < assembly.grains; ++grain) {
		const auto& b = (*scene->bodies)[bodyIds[grain]];
		if (b && b->bound && nearBound(assembly, grain, *b->bound)) scene->doSort = true;
	}
}

namespace {

	State* stateOf(const Body* body) { return body ? body->state.get() : nullptr; }

	void publishTurn(const flexpm::Assembly& a, int grain, State& state)
	{
		const auto half = flexpm::half_turn(a, grain);
		state.ori       = Quaternionr(half.cosine, 0, 0, half.sine);
		state.angVel    = Vector3r(0, 0, a.spin[flexpm::rigid_index(a, grain)]);
	}

} // namespace

void GrainSolver::publishBodies()
{
	// bodies and states lie scattered in memory: fetch them some grains ahead, or each would be waited for
	constexpr int bodiesAhead = 24, statesAhead = 12;
	const auto    bodyOf = [&](int grain) { return (*scene->bodies)[bodyIds[std::min(grain, assembly.grains - 1)]].get(); };
	for (int grain = 0; grain < assembly.grains; ++grain) {
		if (const Body* later = bodyOf(grain + bodiesAhead)) __builtin_prefetch(&later->state);
		if (const State* soon = stateOf(bodyOf(grain + statesAhead))) {
			__builtin_prefetch(&soon->pos, 1);
			__builtin_prefetch(&soon->vel, 1);
		}
		State* state = stateOf(bodyOf(grain));
		if (!state) continue;
		const int  centre = assembly.centre(grain);
		const auto p      = assembly.position(centre);
		state->pos        = Vector3r(p.x, p.y, 0);
		state->vel        = Vector3r(assembly.velocity[centre], assembly.velocity[centre + flexpm::lanes], 0);
		if (assembly.is_rigid(grain)) publishTurn(assembly, grain, *state);
	}
}

} // namespace yade
