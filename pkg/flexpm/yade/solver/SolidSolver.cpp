// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  From Python's cells and materials to the state of a solid, its step and what comes at its periods.
#include <flexpm/yade/solver/SolidSolver.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/solid_tests/solid_ends.hpp>
#include <flexpm/kernel/solid_tests/solid_loose.hpp>
#include <flexpm/kernel/solids/solid_build.hpp>
#include <flexpm/kernel/solids/solid_energies.hpp>
#include <flexpm/kernel/solids/solid_pressure.hpp>
#include <flexpm/kernel/solids/solid_step.hpp>
#include <flexpm/kernel/statics/solid_spectrum.hpp>
#include <flexpm/yade/grains/GrainMat.hpp>

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

void SolidSolver::holdEnds(bool bonded) { flexpm::hold_ends(state, bonded); }

void SolidSolver::holdBottom()
{
	flexpm::hold_end(state, flexpm::SolidSide::bottom, false);
	flexpm::hold_against_sliding(state);
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
	requireMasses();
	requireOwnValues();
}

void SolidSolver::action()
{
	requireReady();
	flexpm::step(state, stepOptions());
	if (state.step % checkPeriod == 0) check();
	if (scene->trackEnergy && measured()) trackEnergies();
}

void SolidSolver::check()
{
	const std::string bad = flexpm::find_bad_number(state);
	diverged              = !bad.empty();
	if (diverged) throw std::runtime_error("SolidSolver: " + bad);
	flexpm::find_loose(state);
}

void SolidSolver::mirrorBodies() { }

} // namespace yade
