// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  One step, and what YADE's objects see of it.
#include <flexpm/yade/GrainSolver.hpp>

#include <flexpm/kernel/measures.hpp>
#include <flexpm/kernel/retire.hpp>
#include <flexpm/kernel/stepping.hpp>
#include <flexpm/yade/LobattoContact.hpp>

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
	if (options.measure) check();
}

void GrainSolver::check()
{
	const std::string bad = flexpm::find_bad_number(assembly);
	if (!bad.empty()) throw std::runtime_error("GrainSolver: " + bad);
	// the collider watches centres only when NewtonIntegrator runs, which grains do not need
	for (const Body::id_t id : bodyIds) {
		const auto& b = (*scene->bodies)[id];
		if (b && b->bound && (b->state->pos - b->bound->refPos).norm() > b->bound->sweepLength) scene->doSort = true;
	}
}

void GrainSolver::publishBodies()
{
	for (int grain = 0; grain < assembly.grains; ++grain) {
		const auto& b = (*scene->bodies)[bodyIds[grain]];
		if (!b) continue;
		const int  centre = assembly.centre(grain);
		const auto p      = assembly.position(centre);
		b->state->pos     = Vector3r(p.x, p.y, 0);
		b->state->vel     = Vector3r(assembly.velocity[centre], assembly.velocity[centre + flexpm::lanes], 0);
	}
}

void GrainSolver::retireErased()
{
	seenDestroyed = destroyedContacts();
	for (int c = 0; c < assembly.contacts; ++c) {
		const auto bond = scene->interactions->find(bodyIds[assembly.contact_grains[2 * c]], bodyIds[assembly.contact_grains[2 * c + 1]]);
		if (!bond || !bond->isReal()) flexpm::retire_contact(assembly, c);
	}
	for (int grain = 0; grain < assembly.grains; ++grain) {
		if (!(*scene->bodies)[bodyIds[grain]]) flexpm::retire_grain(assembly, grain);
	}
}

} // namespace yade
