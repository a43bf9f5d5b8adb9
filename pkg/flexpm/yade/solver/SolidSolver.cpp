// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  From Python's cells and materials to the state of a solid, its step and what comes at its periods.
#include <flexpm/yade/solver/SolidSolver.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/laboratory/solid_beam.hpp>
#include <flexpm/kernel/laboratory/solid_ends.hpp>
#include <flexpm/kernel/laboratory/gauge.hpp>
#include <flexpm/kernel/parts/solid_jaws.hpp>
#include <flexpm/kernel/topology/loose_grains.hpp>
#include <flexpm/kernel/laboratory/solid_parts.hpp>
#include <flexpm/kernel/parts/solid_sets.hpp>
#include <flexpm/kernel/space_lanes/solid_access.hpp>
#include <flexpm/kernel/topology/solid_build.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>
#include <flexpm/kernel/step/solid_masses.hpp>
#include <flexpm/kernel/parts/solid_plates.hpp>
#include <flexpm/kernel/forces/solid_pressure.hpp>
#include <flexpm/kernel/step/solid_step.hpp>
#include <flexpm/kernel/statics/solid_spectrum.hpp>
#include <flexpm/yade/grains/GrainMat.hpp>
#include <flexpm/yade/grains/LobattoContact.hpp>

namespace yade {

YADE_PLUGIN((SolidSolver));

SolidSolver::~SolidSolver() = default;

void SolidSolver::postLoad(SolidSolver&)
{
	if (hasGrains()) flexpm::prepare_step(state);
}

void SolidSolver::assembleSolid(const flexpm::Polyhedra& cells, const flexpm::Solid& outline, py::list minerals, py::list pairs, vector<int> kinds, bool rigid)
{
	if (hasGrains()) flexpm::refuse("SolidSolver: grains", state.grains.count, "", "are assembled already; make another SolidSolver");
	flexpm::SolidInput input;
	const auto         ofGrains = materialsOf(minerals);
	for (const auto& m : ofGrains)
		input.grains.push_back(elasticOf(static_cast<const GrainMat&>(*m)));
	for (const auto& m : py::len(pairs) > 0 ? materialsOf(pairs) : ofGrains)
		input.contacts.push_back(contactOf(static_cast<const GrainMat&>(*m)));
	input.kind  = kinds;
	input.rigid = rigid;
	state       = flexpm::make_solid(cells, outline, input);
	keepMaterials(ofGrains);
}

void SolidSolver::scaleMasses()
{
	const Real dt = Omega::instance().getScene()->dt;
	flexpm::scale_masses_closely(state, damping, dt);
	scaled      = true;
	massStep    = dt;
	massDamping = damping;
}

void SolidSolver::holdEnds(bool bonded, Real friction)
{
	flexpm::hold_ends(state, { bonded, friction > 0. });
	if (friction > 0.) flexpm::roughen_plates(state, friction);
}

Real SolidSolver::useRealMasses()
{
	flexpm::set_real_masses(state);
	massStep    = flexpm::stable_step(state, damping);
	massDamping = damping;
	scaled      = false;
	return massStep;
}

void SolidSolver::resetEnergyBalance()
{
	if (state.step > 0) flexpm::refuse("SolidSolver.resetEnergyBalance: steps", double(state.step), "", "must be 0; call it before the first step");
	flexpm::begin_balance(state);
}

py::tuple SolidSolver::sectionNodes(Real place, Vector3r direction, Real width)
{
	const auto section = flexpm::section_at(state.grains, place, { direction[0], direction[1], direction[2] }, width / 2);
	py::list   nodes;
	for (int node : section.nodes)
		nodes.append(node);
	return py::make_tuple(nodes, section.place);
}

bool SolidSolver::holds(int place) const { return !isInScene() || hasInteraction(place); }

void SolidSolver::holdBottom(bool plate)
{
	flexpm::hold_end(state, flexpm::SolidSide::bottom, { false, plate });
	flexpm::hold_against_sliding(state);
}

void SolidSolver::holdDisc(Real jawRadius) { flexpm::add_disc_plates(state, jawRadius); }

int SolidSolver::layLine(int side, Real x, Real z, Real width, bool pinned)
{
	return flexpm::add_line_plate(state, static_cast<flexpm::SolidSide>(side), { x, z, width, pinned });
}

int SolidSolver::findLine(int side, Real x, Real z, Real width, bool pinned)
{
	return flexpm::find_line_plate(state, static_cast<flexpm::SolidSide>(side), { x, z, width, pinned });
}

namespace {

	flexpm::Vector fromYade(const Vector3r& v) { return { v[0], v[1], v[2] }; }

	py::tuple tupleOf(flexpm::Vector v) { return py::make_tuple(v.x, v.y, v.z); }

} // namespace

int SolidSolver::layPatch(Vector3r normal, Vector3r low, Vector3r high, Real friction, bool bonded, Real strip, bool seated)
{
	return flexpm::add_patch_plate(state, { fromYade(normal), fromYade(low), fromYade(high), friction, bonded, strip, seated });
}

int SolidSolver::findPatch(Vector3r normal, Vector3r low, Vector3r high, Real friction, bool bonded, Real strip, bool seated)
{
	return flexpm::find_patch_plate(state, { fromYade(normal), fromYade(low), fromYade(high), friction, bonded, strip, seated });
}

namespace {

	flexpm::SolidJaw jawOf(const Vector3r& towards, Real ratio, Real angle, Real friction, Real strip)
	{
		return { fromYade(towards), ratio, angle, friction, strip };
	}

} // namespace

int SolidSolver::layJaw(Vector3r towards, Real ratio, Real angle, Real friction, Real strip)
{
	return flexpm::add_jaw_plate(state, jawOf(towards, ratio, angle, friction, strip));
}

int SolidSolver::findJaw(Vector3r towards, Real ratio, Real angle, Real friction, Real strip)
{
	return flexpm::find_jaw_plate(state, jawOf(towards, ratio, angle, friction, strip));
}

void SolidSolver::freePlate(int plate) { flexpm::free_plate(state, plate); }

void SolidSolver::setMachine(int plate, Real stiffness) { flexpm::set_machine(state, plate, stiffness); }

py::tuple SolidSolver::gaugePoints(Vector3r first, Vector3r second)
{
	const auto gauge = flexpm::gauge_points(state.grains, { first[0], first[1], first[2] }, { second[0], second[1], second[2] });
	return py::make_tuple(gauge.first, gauge.second, flexpm::gauge_length(state.grains, gauge));
}

py::tuple SolidSolver::elasticConstants()
{
	const auto found = flexpm::constants_between_ends(state);
	return py::make_tuple(found.youngs_modulus, found.poissons_ratio);
}

py::list SolidSolver::plates()
{
	py::list all;
	for (std::size_t i = 0; i < state.plates.size(); ++i) {
		const flexpm::Plate& p = state.plates[i];
		py::dict             d;
		d["side"]          = p.side;
		d["normal"]        = tupleOf(p.normal);
		d["area"]          = p.width;
		d["friction"]      = p.friction;
		d["bonded"]        = p.bonded;
		d["pressed"]       = p.loaded;
		d["place"]         = tupleOf(p.position + p.displacement);
		d["work"]          = p.boundary_work;
		d["displacement"]  = tupleOf(p.displacement);
		d["velocity"]      = tupleOf(p.velocity);
		d["force"]         = tupleOf(p.force);
		d["pressed_area"]  = flexpm::pressed_area(p);
		d["strip"]         = p.strip;
		d["radius"]        = p.jaw_radius;
		d["machine"]       = p.machine_stiffness;
		d["machine_give"]  = p.machine_give;
		d["contact_angle"] = flexpm::contact_angle(state, static_cast<int>(i));
		d["seated"]        = p.seated;
		d["angle"]         = tupleOf(p.turn);
		all.append(d);
	}
	return all;
}

py::tuple SolidSolver::nodePlaces(bool bonded)
{
	const auto          nodes = flexpm::holdable_nodes(state);
	std::vector<double> places;
	for (int node : nodes) {
		const auto p = bonded ? flexpm::space_vector(state.grains.reference, node) : state.grains.position(node);
		places.insert(places.end(), { p.x, p.y, p.z });
	}
	return py::make_tuple(flexpm_bindings::copied(nodes, 0), flexpm_bindings::copied(places, 3));
}

int SolidSolver::addNodeSet(vector<int> nodes, bool x, bool y, bool z) { return flexpm::add_node_set(state, nodes, { x, y, z }); }

void SolidSolver::turnNodeSet(int set, py::object about)
{
	if (about.is_none()) throw std::invalid_argument("turnNodeSet: about = None, must be a place: no node set of a solid floats");
	const Vector3r pivot = py::extract<Vector3r>(about);
	flexpm::set_pivot(state, set, fromYade(pivot));
}

void SolidSolver::moveNodeSet(int set, Vector3r velocity, Vector3r spin)
{
	const Real dt = Omega::instance().getScene()->dt;
	flexpm::set_motion_of(state, set, fromYade(velocity), fromYade(spin), dt);
	flexpm::promise_work(state, dt);
}

py::list SolidSolver::nodeSets()
{
	py::list all;
	for (const flexpm::NodeSet& set : state.node_sets) {
		py::dict d;
		d["nodes"]        = flexpm_bindings::copied(set.nodes, 0);
		d["axes"]         = string(set.holds_x ? "x" : "") + (set.holds_y ? "y" : "") + (set.holds_z ? "z" : "");
		d["floats"]       = false;
		d["place"]        = tupleOf(set.pivot);
		d["displacement"] = tupleOf(set.displacement);
		d["angle"]        = tupleOf(set.angle);
		d["force"]        = tupleOf(set.force);
		d["moment"]       = tupleOf(set.moment);
		d["work"]         = set.work;
		all.append(d);
	}
	return all;
}

void SolidSolver::clearPressure(int side) { flexpm::set_pressure(state, side, 0.); }

void SolidSolver::holdSide(int side, bool x, bool y, bool z)
{
	const bool axes[] = { x, y, z };
	for (int axis = 0; axis < 3; ++axis)
		if (axes[axis]) flexpm::hold_side(state, side, axis);
}

void SolidSolver::requireReady() const
{
	requireGrains();
	requirePeriods();
	requireInScene();
	requireMasses();
	requireOwnValues();
}

void SolidSolver::takeStep()
{
	try {
		flexpm::step(state, stepOptions());
	} catch (const std::runtime_error&) { // of faces that have turned over: the record up to here is good
		diverged = true;
		throw;
	}
}

void SolidSolver::action()
{
	requireReady();
	if (state.step % checkPeriod == 0) {
		requireOwnScene();
		flexpm::find_loose(state);
	}
	if (state.step % checkPeriod == 0 || destroyedContacts() != seenDestroyed) removeErased();
	takeStep();
	flexpm::sum_node_sets(state, scene->dt);
	if (state.step % mirrorPeriod == 0) mirrorStates();
	if (state.step % checkPeriod == 0) check();
	if (scene->trackEnergy && measured()) trackEnergies();
	mirrorAtStop();
}

void SolidSolver::removeErased()
{
	seenDestroyed = destroyedContacts();
	int  grains = 0, bonds = 0;
	auto world = Omega::instance().getScene();
	for (int grain = 0; grain < state.grains.count; ++grain)
		grains += !bodyOf(*world, grain);
	for (int c = 0; c < state.contacts.count; ++c)
		bonds += !hasInteraction(c);
	if (grains == 0 && bonds == 0) return;
	flexpm::fail(
	        "SolidSolver: grains and bonds that are erased",
	        std::to_string(grains) + " and " + std::to_string(bonds),
	        "must be 0: a solid keeps them; build the specimen again (O.reset(), flexpm.build)");
}

void SolidSolver::findStates()
{
	const auto world = Omega::instance().getScene(); // an engine knows its scene from its first step on
	states.assign(state.grains.count, nullptr);
	for (int grain = 0; grain < state.grains.count; ++grain) {
		if (const Body* body = bodyOf(*world, grain)) states[grain] = body->state;
	}
}

void SolidSolver::mirrorStates()
{
	requireInScene();
	const auto& grains = state.grains;
	if (int(states.size()) != grains.count) findStates();
	for (int grain = 0; grain < grains.count; ++grain) {
		if (!states[grain]) continue;
		State&    shown    = *states[grain];
		const int centre   = grains.centre(grain);
		shown.se3.position = toYade(grains.position(centre));
		shown.vel          = toYade(grains.vector(grains.velocity, centre));
		if (!grains.is_rigid(grain)) continue;
		const auto& body      = state.bodies[grain];
		shown.se3.orientation = Quaternionr(body.turn.w, body.turn.v.x, body.turn.v.y, body.turn.v.z);
		shown.angVel          = toYade(body.spin);
	}
}

} // namespace yade
