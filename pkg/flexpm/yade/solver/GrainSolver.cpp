// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  One step, and what YADE's objects see of it.
#include <flexpm/yade/solver/GrainSolver.hpp>

#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/motion/centre_motion.hpp>
#include <flexpm/kernel/step/step_plan.hpp>
#include <flexpm/yade/grains/LobattoContact.hpp>

#include <algorithm>

namespace yade {

CREATE_LOGGER(GrainSolver);
YADE_PLUGIN((GrainSolver));

GrainSolver::~GrainSolver() = default;

shared_ptr<GrainSolver> GrainSolver::ofScene(const Scene& scene) { return YADE_PTR_CAST<GrainSolver>(assemblyOf(scene).engine); }

void GrainSolver::postLoad(GrainSolver&)
{
	if (assembly.grains.count > 0) flexpm::prepare_step(assembly);
}

void GrainSolver::preSave(GrainSolver&) { current(); }

void GrainSolver::takeStep()
{
	forEngines();
	if (assembly.step == 0) flexpm::reset_energy_balance(assembly);
	flexpm::StepOptions options;
	options.dt      = scene->dt;
	options.damping = damping;
	options.threads = threads();
	options.measure = (assembly.step + 1) % measurePeriod == 0;
	flexpm::step(assembly, options);
}

void GrainSolver::action()
{
	requireReady();
	if (assembly.step % checkPeriod == 0) requireOwnScene();
	takeStep();
	if (assembly.step % mirrorPeriod == 0) mirrorBodies();
	if (assembly.step % touchPeriod == 0) changeContacts();
	if (assembly.step % checkPeriod == 0) check();
}

namespace {

	/// A node has used up half of the way that its grain's bound leaves it; what is left is for the steps until the next look.
	bool nearBound(const flexpm::Grains& grains, int grain, const Bound& bound)
	{
		const Real margin = .5 * bound.sweepLength;
		for (int n = 0; n < grains.nodes_of(grain); ++n) {
			const auto p = grains.position(grains.node(grain, n));
			if (p.x < bound.min[0] + margin || p.x > bound.max[0] - margin || p.y < bound.min[1] + margin || p.y > bound.max[1] - margin)
				return true;
		}
		return false;
	}

} // namespace

void GrainSolver::check()
{
	const std::string bad = flexpm::find_bad_number(assembly);
	diverged              = !bad.empty();
	if (diverged) throw std::runtime_error("GrainSolver: " + bad);
	removeErased(); // a script that keeps a handle delays its destruction
	findStates();   // a script may have replaced one
	// the collider watches centres only, when NewtonIntegrator runs, which grains do not need
	for (int grain = 0; grain < assembly.grains.count; ++grain) {
		const Body* b = bodyOf(*scene, grain);
		if (b && b->bound && nearBound(assembly.grains, grain, *b->bound)) scene->doSort = true;
	}
}

void GrainSolver::findStates()
{
	const auto slots = assembly.grains.in_slot.size();
	const auto world = Omega::instance().getScene(); // an engine knows its scene from its first step on
	states.assign(slots, nullptr);
	for (std::size_t slot = 0; slot < slots; ++slot) {
		const int grain = assembly.grains.in_slot[slot];
		if (grain < 0) continue;
		if (const Body* body = bodyOf(*world, grain)) states[slot] = body->state;
	}
}

namespace {

	/// States lie scattered in memory: fetch them some blocks ahead, or each would be waited for.
	constexpr int statesAhead = 2;
	void          prefetch(const State& state)
	{
		__builtin_prefetch(&state.se3, 1);
		__builtin_prefetch(&state.angVel, 1);
	}

	void mirror(const flexpm::CentreMotion& motion, int lane, bool rigid, State& state)
	{
		// through se3: State::pos and State::ori are references, which would have to be fetched first
		state.se3.position = Vector3r(motion.x[lane], motion.y[lane], 0);
		state.vel          = Vector3r(motion.vx[lane], motion.vy[lane], 0);
		if (!rigid) return;
		state.se3.orientation = Quaternionr(motion.half_cosine[lane], 0, 0, motion.half_sine[lane]);
		state.angVel          = Vector3r(0, 0, motion.spin[lane]);
	}

} // namespace

void GrainSolver::mirrorBodies()
{
	requireInScene();
	if (states.size() != assembly.grains.in_slot.size()) findStates();
	flexpm::CentreMotion motion;
	for (int block = 0; block < assembly.grains.blocks(); ++block) {
		const auto* later = states.data() + std::min(flexpm::lanes * (block + statesAhead), int(states.size()) - flexpm::lanes);
		const auto* now   = states.data() + flexpm::lanes * block;
		const bool  rigid = assembly.grains.group(block).rigid;
		flexpm::find_centre_motion(assembly.grains, block, motion);
		for (int lane = 0; lane < flexpm::lanes; ++lane) {
			if (later[lane]) prefetch(*later[lane]);
			if (now[lane]) mirror(motion, lane, rigid, *now[lane]);
		}
	}
}

} // namespace yade
