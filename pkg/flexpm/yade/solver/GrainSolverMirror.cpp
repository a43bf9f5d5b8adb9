// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  What YADE's objects and functions see of the grains: states, bonds, forces, energies.
#include <flexpm/yade/solver/GrainSolver.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/plane_lanes/centre_motion.hpp>
#include <flexpm/kernel/plane_lanes/rigid_grain.hpp>
#include <flexpm/kernel/space_lanes/solid_access.hpp>
#include <flexpm/yade/grains/LobattoContact.hpp>

#include <algorithm>

namespace yade {

void GrainSolver::findStates()
{
	const auto& grains = this->grains();
	const auto  world  = Omega::instance().getScene(); // an engine knows its scene from its first step on
	const bool  plane  = dimension() == 2;
	states.assign(plane ? grains.in_slot.size() : grains.count, nullptr);
	for (int grain = 0; grain < grains.count; ++grain) {
		if (const Body* body = bodyOf(*world, grain)) states[plane ? grains.slot[grain] : grain] = body->state;
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

void GrainSolver::mirrorStates()
{
	requireInScene();
	if (isSolid())
		mirrorSolid();
	else
		mirrorPlane();
}

void GrainSolver::mirrorSolid()
{
	const auto& grains = space.grains;
	if (int(states.size()) != grains.count) findStates();
	for (int grain = 0; grain < grains.count; ++grain) {
		if (!states[grain]) continue;
		State&    shown    = *states[grain];
		const int centre   = grains.centre(grain);
		shown.se3.position = toYade(grains.position(centre));
		shown.vel          = toYade(grains.vector(grains.velocity, centre));
		if (!grains.is_rigid(grain)) continue;
		const auto& body      = space.bodies[grain];
		shown.se3.orientation = Quaternionr(body.turn.w, body.turn.v.x, body.turn.v.y, body.turn.v.z);
		shown.angVel          = toYade(body.spin);
	}
}

void GrainSolver::mirrorPlane()
{
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

void GrainSolver::mirrorBodies()
{
	const auto world = Omega::instance().getScene();
	mirrorStates();
	mirrorBonds(*world);
	mirrorForces(*world);
}

void GrainSolver::mirrorAtStop()
{
	// it takes the time of some steps: not within a run
	const bool goesOn = stepsToCome > 0 && --stepsToCome > 0;
	const bool stops  = !goesOn && (!Omega::instance().isRunning() || scene->stopAtIter == scene->iter + 1);
	if (stops && mirrorPeriod == 1) {
		mirrorBonds(*scene);
		mirrorForces(*scene);
	} else if (bondsShown) {
		hideBonds(*scene);
	}
}

namespace {

	/// Call visit(geom, phys) for the bonds among a scene's interactions.
	template <class Visit> void forEachBond(const Scene& world, Visit visit)
	{
		for (const auto& interaction : *world.interactions) {
			if (!interaction || !interaction->isReal()) continue;
			auto* geom = dynamic_cast<LobattoGeom*>(interaction->geom.get());
			auto* phys = dynamic_cast<LobattoPhys*>(interaction->phys.get());
			if (geom && phys) visit(*geom, *phys);
		}
	}

} // namespace

void GrainSolver::mirrorBonds(const Scene& world)
{
	showNodes();
	forEachBond(world, [&](LobattoGeom& geom, LobattoPhys& phys) {
		const int place = contactAt(own(), phys.contact);
		if (place >= 0) return mirrorBond(own(), place, geom, phys);
		hideBond(geom, phys);
	});
	bondsShown = true;
}

void GrainSolver::hideBonds(const Scene& world)
{
	forEachBond(world, hideBond);
	bondsShown = false;
}

void GrainSolver::mirrorForces(Scene& world)
{
	struct Change {
		Body::id_t id;
		Vector3r   force, torque;
	};
	vector<Change> changes;
	world.forces.sync();
	for (int grain = 0; grain < grainCount(); ++grain) {
		const Body* body = bodyOf(world, grain);
		if (!body) continue;
		const auto id  = body->getId();
		const auto now = onState([&](const auto& state) { return flexpm::resultant_on(state, grain); });
		// YADE adds forces up until it resets them: what the last look has left is taken off
		changes.push_back({ id, toYade(now.force) - world.forces.getForce(id), toYade(now.moment) - world.forces.getTorque(id) });
	}
	for (const Change& change : changes) {
		world.forces.addForce(change.id, change.force);
		world.forces.addTorque(change.id, change.torque);
	}
	world.forces.sync();
}

void GrainSolver::trackEnergies()
{
	const auto e   = onState([](const auto& state) { return flexpm::energies(state); });
	const auto set = [this](const char* name, Real value) {
		int id = -1;
		scene->energy->set(value, name, id);
	};
	set("kinetic_energy", e.kinetic);
	set("elastic_energy", e.elastic);
	set("damage_energy", e.damage);
	set("friction_energy", e.friction);
	set("damping_energy", e.damping);
	set("drag_energy", e.drag);
	set("potential_energy", e.potential);
	set("erased_energy", e.erased);
	set("boundary_work_taken", -e.boundary_work); // YADE's sum of all then stays as it is
}

} // namespace yade
