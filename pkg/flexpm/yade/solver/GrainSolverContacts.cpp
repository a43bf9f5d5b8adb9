// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Contacts that come and go: the kernel's contacts to interactions.
#include <flexpm/yade/solver/GrainSolver.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/step/solid_masses.hpp>
#include <flexpm/kernel/topology/crack_faces.hpp>
#include <flexpm/yade/grains/LobattoContact.hpp>

#include <algorithm>
#include <mutex>

namespace yade {

bool GrainSolver::isInScene() const
{
	const bool inserted = int(bodyIds.size()) == grainCount();
	return inserted && findAssembly(*Omega::instance().getScene()).engine.get() == this;
}

OwnedAssembly GrainSolver::own() const
{
	auto& self = const_cast<GrainSolver&>(*this);
	return { nullptr, self.solid() ? nullptr : &self.assembly, self.solid() };
}

bool GrainSolver::hasInteraction(int contact) const
{
	const auto       owned = own();
	const auto&      pairs = owned.space ? owned.space->contacts.pairs : owned.plane->contacts.pairs;
	const Body::id_t id1 = bodyIds[pairs[contact][0]], id2 = bodyIds[pairs[contact][1]];
	auto&            all = *Omega::instance().getScene()->interactions;
	places.resize(pairs.size());
	auto& place = places[contact];
	if (place < all.size()) { // most are where they were: finding costs more
		const auto& there = all[place];
		if (there && there->getId1() == id1 && there->getId2() == id2) return there->isReal();
	}
	const auto& bond = all.find(id1, id2);
	if (bond) place = bond->linIx;
	return bond && bond->isReal();
}

bool GrainSolver::holds(int place) const
{
	if (dimension() == 3) return !isInScene() || hasInteraction(place);
	if (assembly.contacts.erased[place]) return false;
	return !isInScene() || !flexpm::is_active(assembly.contacts, place) || hasInteraction(place);
}

flexpm::Assembly& GrainSolver::current()
{
	if (isInScene()) removeErased();
	return assembly;
}

flexpm::Assembly& GrainSolver::forEngines() { return destroyedContacts() != seenDestroyed ? current() : assembly; }

flexpm::Erasure GrainSolver::findErased() const
{
	const Scene&    world = *Omega::instance().getScene();
	flexpm::Erasure found;
	for (int grain = 0; grain < assembly.grains.count; ++grain) {
		if (!assembly.grains.erased[grain] && !bodyOf(world, grain)) found.grains.push_back(grain);
	}
	for (int c = 0; c < assembly.contacts.count; ++c) {
		if (flexpm::is_active(assembly.contacts, c) && !hasInteraction(c)) found.contacts.push_back(c);
	}
	return found;
}

void GrainSolver::removeErased()
{
	seenDestroyed = destroyedContacts();
	if (isSolid()) return refuseErased();
	listed          = false;
	const auto what = findErased();
	if (what.empty()) return;
	const auto                        world = Omega::instance().getScene();
	const std::lock_guard<std::mutex> lock(world->interactions->drawloopmutex); // a window may be drawing contacts
	flexpm::erase(assembly, what, world->dt);
	nearPairs.forget(); // what was erased may touch again
}

void GrainSolver::refuseErased()
{
	int         grains = 0, bonds = 0;
	const auto& world = *Omega::instance().getScene();
	for (int grain = 0; grain < space.grains.count; ++grain)
		grains += !bodyOf(world, grain);
	for (int c = 0; c < space.contacts.count; ++c)
		bonds += !hasInteraction(c);
	if (grains == 0 && bonds == 0) return;
	flexpm::fail(
	        getClassName() + ": grains and bonds that are erased",
	        std::to_string(grains) + " and " + std::to_string(bonds),
	        "must be 0 in 3D; build the specimen again (O.reset(), flexpm.build)");
}

void GrainSolver::listCandidates()
{
	candidates = nearPairs.find(assembly, touchMargin * 2 * assembly.grains.radius[0]);
	listed     = true;
}

void GrainSolver::changeContacts()
{
	vector<int> ended;
	if (!listed) listCandidates(); // also in a scene that was loaded
	if (assembly.step % checkPeriod == 0) {
		followFaces();
		listCandidates();
		ended = flexpm::ended_contacts(assembly);
		if (flexpm::follow_touches(assembly, massDamping, scaled ? scene->dt : 0.)) limitStep();
	}
	vector<flexpm::GrainPair> touching;
	for (const auto& pair : candidates) {
		if (flexpm::is_touching(assembly, pair)) touching.push_back(pair);
	}
	if (ended.empty() && touching.empty()) return;
	for (int c : ended)
		scene->interactions->requestErase(bodyIds[assembly.contacts.pairs[c][0]], bodyIds[assembly.contacts.pairs[c][1]]);
	const int firstId = assembly.contacts.next_id;
	{
		const std::lock_guard<std::mutex> lock(scene->interactions->drawloopmutex); // a window may be drawing contacts
		flexpm::change_contacts(assembly, ended, touching, massDamping, scaled ? scene->dt : 0.);
	}
	if (!touching.empty()) limitStep();
	insertTouches(firstId);
	nearPairs.forget();
	listCandidates();
}

void GrainSolver::followFaces()
{
	vector<flexpm::GrainPair> changed;
	{
		const std::lock_guard<std::mutex> lock(scene->interactions->drawloopmutex); // a window may be drawing contacts
		const Real                        massesFor = scaled ? scene->dt : 0.;
		changed                                     = flexpm::follow_faces(assembly, massDamping, massesFor);
		const auto cracks                           = flexpm::follow_cracks(assembly, massDamping, massesFor);
		changed.insert(changed.end(), cracks.pairs.begin(), cracks.pairs.end());
		if (cracks.any || !changed.empty()) limitStep();
	}
	if (changed.empty()) return;
	for (const auto& pair : changed)
		showContactOf(pair);
	seenDestroyed = destroyedContacts();
	nearPairs.forget();
}

void GrainSolver::showContactOf(const flexpm::GrainPair& pair)
{
	const auto& pairs = assembly.contacts.pairs;
	const auto  all   = std::equal_range(pairs.begin(), pairs.end(), pair);
	for (auto one = all.first; one != all.second; ++one) {
		const int place = int(one - pairs.begin());
		if (flexpm::is_active(assembly.contacts, place)) return showContact(place);
	}
	scene->interactions->requestErase(bodyIds[pair[0]], bodyIds[pair[1]]);
}

void GrainSolver::showContact(int place)
{
	const auto&      grains = assembly.contacts.pairs[place];
	const int        id     = assembly.contacts.id[place];
	const Body::id_t id1 = bodyIds[grains[0]], id2 = bodyIds[grains[1]];
	auto             pair = scene->interactions->find(id1, id2);
	if (!pair) {
		pair = boost::make_shared<Interaction>(id1, id2);
		scene->interactions->insert(pair);
	}
	const auto* shown = dynamic_cast<const LobattoPhys*>(pair->phys.get());
	if (pair->isReal() && shown && shown->contact == id) return;
	if (!pair->isReal()) pair->iterMadeReal = scene->iter;
	makeBond(own(), id, *pair);
	bondsShown = true; // until the end of the step
}

void GrainSolver::limitStep()
{
	// scaled masses rise with new contacts; real ones do not, so the step falls
	if (scaled) return;
	const Real stable = onState([this](const auto& state) { return Real(flexpm::stable_step(state, massDamping)); });
	massStep          = std::min(massStep, stable);
	scene->dt         = std::min(scene->dt, massStep);
}

void GrainSolver::insertTouches(int firstId)
{
	for (int c = 0; c < assembly.contacts.count; ++c) {
		if (assembly.contacts.id[c] >= firstId) showContact(c);
	}
	seenDestroyed = destroyedContacts();
}

} // namespace yade
