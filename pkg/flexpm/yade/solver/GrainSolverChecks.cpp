// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  What must hold before the solver is asked or stepped; scripts can change anything between two steps.
#include <flexpm/yade/solver/GrainSolver.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/yade/grains/GrainMat.hpp>
#include <flexpm/yade/grains/LaguerreCell.hpp>

#include <algorithm>

#include <omp.h>
#include <unistd.h>

namespace yade {

using flexpm::fail;
using flexpm::number;

namespace {

	const std::string buildAgain = "; build the specimen again (O.reset(), flexpm.build)";

	void requirePeriod(const char* name, int steps)
	{
		if (steps < 1) fail(std::string("GrainSolver.") + name, std::to_string(steps), "must be >= 1 step; give a larger number");
	}

	/// Cores of the machine.
	int cores()
	{
		static const int count = std::max(1L, sysconf(_SC_NPROCESSORS_ONLN));
		return count;
	}

} // namespace

void GrainSolver::requirePlane() const
{
	requireGrains();
	if (dimension() == 3) fail("GrainSolver: specimen", "3D", "must be 2D for this call; the page 'Available in 2D and 3D' names an alternative");
}

void GrainSolver::requireSolid() const
{
	requireGrains();
	if (dimension() == 2) fail("GrainSolver: specimen", "2D", "must be 3D for this call; use addSidePlates, addPatchPlate or addJawPlate in 2D");
}

void GrainSolver::requireGrains() const
{
	if (!hasGrains()) fail("GrainSolver: grains", "0", "must be assembled; build the specimen first (flexpm.build)");
}

bool GrainSolver::measured() const
{
	requirePeriod("measurePeriod", measurePeriod);
	return stepsDone() % measurePeriod == 0;
}

void GrainSolver::requireReady() const
{
	requireGrains();
	requirePeriods();
	if (!(touchMargin >= 0 && touchMargin <= 10)) fail("GrainSolver.touchMargin", number(touchMargin), "must be 0 to 10 diameters; correct it");
	requireInScene();
	requireMasses();
	requireOwnValues();
}

void GrainSolver::requirePeriods() const
{
	requirePeriod("measurePeriod", measurePeriod);
	requirePeriod("mirrorPeriod", mirrorPeriod);
	requirePeriod("touchPeriod", touchPeriod);
	requirePeriod("checkPeriod", checkPeriod);
}

void GrainSolver::requireOwnValues() const
{
	for (std::size_t i = 0; i < materials.size(); ++i)
		requireValues(static_cast<const GrainMat&>(*materials[i]), materialValues[i]);
}

void GrainSolver::requireInScene() const
{
	if (bodyIds.size() == std::size_t(grainCount())) return;
	fail("GrainSolver.bodyIds",
	     std::to_string(bodyIds.size()) + " bodies",
	     "must be one for each of " + std::to_string(grainCount()) + " grains; call addToScene() once, or flexpm.build");
}

void GrainSolver::requireMasses() const
{
	const std::string again = scaled ? "scaleMasses()" : "useRealMasses()";
	if (massStep == 0) fail("GrainSolver: masses", "none", "must be set; call scaleMasses() or useRealMasses()");
	if (scaled ? scene->dt != massStep : !(scene->dt > 0 && scene->dt <= massStep)) {
		fail("O.dt",
		     number(scene->dt) + " s",
		     std::string(scaled ? "must be " : "must be above 0 and at most ") + number(massStep) + " s as the masses are; call GrainSolver." + again
		             + " after a change");
	}
	if (!(damping >= 0 && damping <= massDamping)) {
		fail("GrainSolver.damping",
		     number(damping),
		     "must be from 0 to " + number(massDamping) + " as the masses are; set it below 1 and call " + again);
	}
}

int GrainSolver::threads() const
{
	if (ompThreads == -1) return std::min(omp_get_max_threads(), cores());
	if (ompThreads >= 1 && ompThreads <= cores()) return ompThreads;
	fail("GrainSolver.ompThreads",
	     std::to_string(ompThreads),
	     "must be 1 to " + std::to_string(cores()) + ", the cores of this machine, or -1 for the threads of YADE; correct it");
}

Body* GrainSolver::bodyOf(const Scene& world, int grain) const
{
	const auto id = bodyIds[grain];
	if (!world.bodies->exists(id)) return nullptr;
	Body* const body = (*world.bodies)[id].get();
	// after O.bodies.clear() the number may be that of a body of the script
	const auto* cell = dynamic_cast<const LaguerreCell*>(body->shape.get());
	return cell && cell->grain == grain ? body : nullptr;
}

void GrainSolver::requireOwnScene() const
{
	if (ofScene(*scene).get() != this) fail("GrainSolver: O.engines", "two engines with grains", "must have one" + buildAgain);
	bool any = false;
	for (int grain = 0; grain < grainCount(); ++grain) {
		const Body* body = bodyOf(*scene, grain);
		if (!body) continue;
		any = true;
		if (body->material == materials[(isSolid() ? space.grains : assembly.grains).material[grain]]) continue;
		fail("O.bodies[" + std::to_string(bodyIds[grain]) + "].material", "changed", "must stay as built" + buildAgain);
	}
	if (!any) fail("GrainSolver: grains in O.bodies", "0", "must be at least 1" + buildAgain);
}

} // namespace yade
