// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Ends, plates, lines and jaws that scripts lay on a specimen in 3D.
#include <flexpm/yade/solver/GrainSolver.hpp>

#include <flexpm/kernel/laboratory/solid_beam.hpp>
#include <flexpm/kernel/laboratory/solid_ends.hpp>
#include <flexpm/kernel/parts/solid_jaws.hpp>
#include <flexpm/kernel/parts/solid_patches.hpp>
#include <flexpm/kernel/parts/solid_plates.hpp>

namespace yade {

void GrainSolver::holdEnds(bool bonded, Real friction)
{
	flexpm::hold_ends(space, { bonded, friction > 0. });
	if (friction > 0.) flexpm::roughen_plates(space, friction);
}

void GrainSolver::holdBottom(bool plate)
{
	flexpm::hold_end(space, flexpm::SolidSide::bottom, { false, plate });
	flexpm::hold_against_sliding(space);
}

void GrainSolver::holdDisc(Real jawRadius) { flexpm::add_disc_plates(space, jawRadius); }

int GrainSolver::layLine(int side, Real x, Real z, Real width, bool pinned)
{
	return flexpm::add_line_plate(space, static_cast<flexpm::SolidSide>(side), { x, z, width, pinned });
}

int GrainSolver::findLine(int side, Real x, Real z, Real width, bool pinned)
{
	return flexpm::find_line_plate(space, static_cast<flexpm::SolidSide>(side), { x, z, width, pinned });
}

int GrainSolver::layPatch(Vector3r normal, Vector3r low, Vector3r high, Real friction, bool bonded, Real strip, bool seated)
{
	return flexpm::add_patch_plate(space, { fromYade(normal), fromYade(low), fromYade(high), friction, bonded, strip, seated });
}

int GrainSolver::findPatch(Vector3r normal, Vector3r low, Vector3r high, Real friction, bool bonded, Real strip, bool seated)
{
	return flexpm::find_patch_plate(space, { fromYade(normal), fromYade(low), fromYade(high), friction, bonded, strip, seated });
}

namespace {

	flexpm::SolidJaw jawOf(const Vector3r& towards, Real ratio, Real angle, Real friction, Real strip)
	{
		return { fromYade(towards), ratio, angle, friction, strip };
	}

} // namespace

int GrainSolver::layJaw(Vector3r towards, Real ratio, Real angle, Real friction, Real strip)
{
	return flexpm::add_jaw_plate(space, jawOf(towards, ratio, angle, friction, strip));
}

int GrainSolver::findJaw(Vector3r towards, Real ratio, Real angle, Real friction, Real strip)
{
	return flexpm::find_jaw_plate(space, jawOf(towards, ratio, angle, friction, strip));
}

void GrainSolver::freePlate(int plate) { flexpm::free_plate(space, plate); }

} // namespace yade
