// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Looping over discs.
#include <flexpm/yade/packing/DiscLoop.hpp>

namespace yade {

YADE_PLUGIN((DiscLoop));

DiscLoop::~DiscLoop() = default;

void DiscLoop::action()
{
	updateScene();
	readPlaces();
	auto& interactions = *scene->interactions;
	rows.resize(interactions.size());
	for (std::size_t k = 0; k < rows.size(); ++k) {
		const auto& interaction = interactions[k];
		Row&        row         = rows[k];
		if (row.interaction != interaction) row = makeRow(interaction);
		if (row.plain && push(row)) continue;
		dispatch(interaction);
		row = makeRow(interaction);
	}
}

void DiscLoop::updateScene()
{
	geomDispatcher->scene = physDispatcher->scene = lawDispatcher->scene = scene;
	geomDispatcher->updateScenePtr();
	physDispatcher->updateScenePtr();
	lawDispatcher->updateScenePtr();
}

void DiscLoop::readPlaces()
{
	const auto& bodies = scene->bodies->body;
	places.resize(bodies.size());
	for (std::size_t k = 0; k < bodies.size(); ++k) {
		if (bodies[k]) places[k] = { bodies[k]->state->pos[0], bodies[k]->state->pos[1], bodies[k]->state->pos[2] };
	}
}

namespace {

	template <class Functor> void require(const shared_ptr<Functor>& functor, const char* what)
	{
		if (!functor) throw std::runtime_error("DiscLoop: " + std::string(what) + " = no functor, must have one; add it to the loop");
	}

	const Sphere* sphereOf(int id, const Scene* scene)
	{
		const auto& body = (*scene->bodies)[id];
		return body ? dynamic_cast<const Sphere*>(body->shape.get()) : nullptr;
	}

} // namespace

DiscLoop::Row DiscLoop::makeRow(const shared_ptr<Interaction>& interaction) const
{
	Row row;
	row.interaction = interaction;
	row.first       = interaction->getId1();
	row.second      = interaction->getId2();
	const auto *a = sphereOf(row.first, scene), *b = sphereOf(row.second, scene);
	row.plain = a && b;
	if (!row.plain) return row;
	row.pair.radius_sum = a->radius + b->radius;
	row.pair.touching   = interaction->isReal();
	if (!row.pair.touching) return row;
	const auto* contact = dynamic_cast<const NormShearPhys*>(interaction->phys.get());
	row.plain           = contact && contact->ks == 0;
	if (row.plain) row.pair.stiffness = contact->kn;
	return row;
}

bool DiscLoop::push(const Row& row)
{
	if (mirror && row.pair.touching && !row.interaction->isReal()) return false; // a script has reset it
	const flexpm::PairPush step = flexpm::push_apart(row.pair, places[row.first], places[row.second]);
	if (step.changes || !row.pair.touching) return !step.changes;
	const Vector3r force(step.push.x, step.push.y, step.push.z);
	scene->forces.addForce(row.first, -force);
	scene->forces.addForce(row.second, force);
	if (mirror) static_cast<NormPhys&>(*row.interaction->phys).normalForce = force;
	return true;
}

void DiscLoop::dispatch(const shared_ptr<Interaction>& interaction)
{
	auto& functors = interaction->functorCache;
	if (!functors.geomExists) return;
	const auto body = [&](int id) -> Body& { return *Body::byId(id, scene); };
	for (int id : { interaction->getId1(), interaction->getId2() }) {
		if (!Body::byId(id, scene)) {
			scene->interactions->requestErase(interaction);
			return;
		}
		if (!body(id).shape) return;
	}
	bool swap = false;
	if (!functors.geom) functors.geom = geomDispatcher->getFunctor2D(body(interaction->getId1()).shape, body(interaction->getId2()).shape, swap);
	functors.geomExists = bool(functors.geom);
	if (!functors.geomExists) return;
	if (swap) interaction->swapOrder();

	Body &     first = body(interaction->getId1()), &second = body(interaction->getId2());
	const bool wasReal = interaction->isReal();
	if (!functors.geom->go(first.shape, second.shape, *first.state, *second.state, Vector3r::Zero(), false, interaction)) {
		if (wasReal) scene->interactions->requestErase(interaction);
		return;
	}
	if (!functors.phys) functors.phys = physDispatcher->getFunctor2D(first.material, second.material, swap);
	require(functors.phys, "physics of a contact");
	functors.phys->go(first.material, second.material, interaction);
	if (!wasReal) interaction->iterMadeReal = scene->iter;
	if (!functors.constLaw) functors.constLaw = lawDispatcher->getFunctor2D(interaction->geom, interaction->phys, swap);
	require(functors.constLaw, "law of a contact");
	if (!functors.constLaw->go(interaction->geom, interaction->phys, interaction.get())) scene->interactions->requestErase(interaction);
}

} // namespace yade
