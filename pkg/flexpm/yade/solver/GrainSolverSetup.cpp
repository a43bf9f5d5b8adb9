// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  From Python's specimen and materials to the solver's arrays, bodies and interactions.
#include <flexpm/yade/solver/GrainSolver.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/forces/gravity.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/statics/solid_loading.hpp>
#include <flexpm/kernel/statics/solid_spectrum.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/step/solid_masses.hpp>
#include <flexpm/kernel/topology/assembly_build.hpp>
#include <flexpm/kernel/topology/solid_build.hpp>
#include <flexpm/kernel/topology/unbonded.hpp>
#include <flexpm/yade/bindings/assembly_input.hpp>
#include <flexpm/yade/grains/GrainMat.hpp>
#include <flexpm/yade/grains/LaguerreCell.hpp>
#include <flexpm/yade/grains/LobattoContact.hpp>

namespace yade {

namespace {

	/// Inner particles: contacts inside a grain are elastic, those between grains may take the normal of the edge.
	void chooseInner(const flexpm_bindings::AssemblyInput& input, flexpm::AssemblyOptions& o)
	{
		const int inside = static_cast<int>(o.laws.size());
		o.laws.push_back(flexpm::unbreakable(o.laws.front()));
		for (const auto outer : input.outer) {
			o.edge_law.push_back(outer != 0 ? 0 : inside);
			o.edge_normal.push_back(outer != 0 && input.edgeNormals);
		}
	}

} // namespace

vector<shared_ptr<Material>> GrainSolver::materialsOf(const py::list& list)
{
	vector<shared_ptr<Material>> all;
	for (py::ssize_t i = 0; i < py::len(list); ++i) {
		const py::extract<shared_ptr<GrainMat>> material(list[i]);
		if (!material.check() || !material())
			flexpm::refuse("material " + std::to_string(i), "another class", "must be a GrainMat; give one for each mineral");
		all.push_back(material());
	}
	return all;
}

void GrainSolver::keepMaterials(const vector<shared_ptr<Material>>& ofGrains)
{
	materials = ofGrains;
	for (const auto& m : ofGrains)
		materialValues.push_back(valuesOf(static_cast<const GrainMat&>(*m)));
}

void GrainSolver::assemble(const flexpm_bindings::AssemblyInput& input, py::list minerals, py::list pairs, py::list joints)
{
	// views of the arrays live as long as the solver
	if (hasGrains()) flexpm::refuse("GrainSolver: grains", grainCount(), "", "are assembled already; make another GrainSolver");
	flexpm::AssemblyOptions o        = input.options;
	const auto              ofGrains = materialsOf(minerals);
	for (const auto& m : ofGrains)
		o.elastic.push_back(elasticOf(static_cast<const GrainMat&>(*m)));
	for (const auto& m : py::len(pairs) > 0 ? materialsOf(pairs) : ofGrains)
		o.laws.push_back(contactOf(static_cast<const GrainMat&>(*m)));
	for (const auto& m : materialsOf(joints))
		o.joints.push_back(contactOf(static_cast<const GrainMat&>(*m)));
	if (!input.outer.empty()) chooseInner(input, o);
	assembly = flexpm::make_assembly(*input.tessellation, input.discs, o);
	keepMaterials(ofGrains);
}

void GrainSolver::takeBonds()
{
	if (stepsDone() > 0) flexpm::refuse(getClassName() + ".takeBonds: steps", double(stepsDone()), "", "must be 0; call it before the first step");
	onState([](auto& state) { flexpm::crack_all_from_start(state); });
}

void GrainSolver::addToScene()
{
	if (!bodyIds.empty()) flexpm::refuse("GrainSolver.bodyIds", static_cast<double>(bodyIds.size()), "bodies", "are in the scene already; add them once");
	insertBodies();
	insertContacts();
	mirrorBodies();
}

namespace {

	struct Mass {
		Real     mass;
		Vector3r inertia; ///< about the axes of the body
	};

	Mass massOf(const flexpm::Assembly& a, int grain)
	{
		const auto whole = flexpm::real_mass(a, grain);
		return { whole.mass, Vector3r(0, 0, whole.inertia) };
	}
	Mass massOf(const flexpm::SolidState& s, int grain)
	{
		const auto whole = flexpm::real_mass(s, grain);
		return { whole.mass, Vector3r(whole.inertia.xx, whole.inertia.yy, whole.inertia.zz) };
	}

	int idOf(const flexpm::Assembly& a, int place) { return a.contacts.id[place]; }
	int idOf(const flexpm::SolidState&, int place) { return place; }

} // namespace

void GrainSolver::insertBodies()
{
	const auto& world = Omega::instance().getScene();
	// bodies and states each in a row: every step walks through them
	vector<shared_ptr<Body>>  bodies(grainCount());
	vector<shared_ptr<State>> ofBodies(grainCount());
	for (auto& body : bodies)
		body = boost::make_shared<Body>();
	for (auto& state : ofBodies)
		state = boost::make_shared<State>();
	for (int grain = 0; grain < grainCount(); ++grain) {
		const auto& body = bodies[grain];
		body->state      = ofBodies[grain];
		auto cell        = boost::make_shared<LaguerreCell>();
		cell->grain      = grain;
		body->shape      = cell;
		body->material   = materials[grains().material[grain]];
		body->state->pos = body->state->refPos = toYade(grains().position(grains().centre(grain)));
		body->state->blockedDOFs               = State::DOF_ALL;
		const auto mass                        = onState([&](const auto& state) { return massOf(state, grain); });
		body->state->mass                      = mass.mass;
		body->state->inertia                   = mass.inertia;
		body->setBounded(true);
		bodyIds.push_back(world->bodies->insert(body));
	}
}

void GrainSolver::insertContacts()
{
	const auto& world = Omega::instance().getScene();
	onState([&](const auto& state) {
		const auto& pairs = state.contacts.pairs;
		for (int c = 0; c < state.contacts.count; ++c) {
			// grains that share several edges have one interaction, which shows the first
			if (c > 0 && pairs[c] == pairs[c - 1]) continue;
			auto bond = boost::make_shared<Interaction>(bodyIds[pairs[c][0]], bodyIds[pairs[c][1]]);
			makeBond(own(), idOf(state, c), *bond);
			bond->iterMadeReal = world->iter;
			world->interactions->insert(bond);
		}
	});
	seenDestroyed = destroyedContacts();
}

void GrainSolver::assembleSolid(
        const flexpm::Polyhedra& cells,
        const flexpm::Solid&     outline,
        py::list                 minerals,
        py::list                 pairs,
        vector<int>              kinds,
        bool                     rigid,
        vector<Real>             strengths,
        py::list                 joints,
        vector<int>              contactJoints)
{
	if (hasGrains()) flexpm::refuse(getClassName() + ": grains", grainCount(), "", "are assembled already; make another " + getClassName());
	flexpm::SolidInput input;
	const auto         ofGrains = materialsOf(minerals);
	for (const auto& m : ofGrains)
		input.grains.push_back(elasticOf(static_cast<const GrainMat&>(*m)));
	for (const auto& m : py::len(pairs) > 0 ? materialsOf(pairs) : ofGrains)
		input.contacts.push_back(contactOf(static_cast<const GrainMat&>(*m)));
	for (const auto& m : materialsOf(joints))
		input.joints.push_back(contactOf(static_cast<const GrainMat&>(*m)));
	input.kind     = kinds;
	input.rigid    = rigid;
	input.strength = strengths;
	input.joint    = contactJoints;
	space          = flexpm::make_solid(cells, outline, input);
	keepMaterials(ofGrains);
}

void GrainSolver::scaleMasses()
{
	const Real dt = Omega::instance().getScene()->dt;
	if (solid())
		flexpm::scale_masses_closely(space, damping, dt);
	else
		flexpm::scale_masses(assembly, damping, dt);
	scaled      = true;
	massStep    = dt;
	massDamping = damping;
}

Real GrainSolver::useRealMasses()
{
	massStep    = onState([this](auto& state) { return flexpm::set_real_masses(state, damping); });
	massDamping = damping;
	scaled      = false;
	return massStep;
}

void GrainSolver::resetEnergyBalance()
{
	if (!solid()) return flexpm::reset_energy_balance(current());
	if (space.step > 0) flexpm::refuse(getClassName() + ".resetEnergyBalance: steps", double(space.step), "", "must be 0; call it before the first step");
	flexpm::begin_balance(space);
}

Vector3r GrainSolver::gravity() const { return Vector3r(state().gravity.x, state().gravity.y, state().gravity.z); }

void GrainSolver::setGravity(Vector3r acceleration)
{
	if (scaled && acceleration != Vector3r::Zero()) {
		throw std::invalid_argument(
		        "GrainSolver.gravity = " + std::to_string(acceleration.norm()) + " m/s^2, must be 0 with scaled masses; call useRealMasses() first");
	}
	flexpm::set_gravity(state(), { acceleration[0], acceleration[1], solid() ? acceleration[2] : 0. });
}

} // namespace yade
