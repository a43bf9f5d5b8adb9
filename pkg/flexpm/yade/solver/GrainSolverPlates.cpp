// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Ends, plates, lines, jaws and walls that scripts lay on a specimen, in 2D and then in 3D.
#include <flexpm/yade/solver/GrainSolver.hpp>

#include <flexpm/kernel/laboratory/solid_beam.hpp>
#include <flexpm/kernel/laboratory/solid_ends.hpp>
#include <flexpm/kernel/parts/part_plates.hpp>
#include <flexpm/kernel/parts/solid_jaws.hpp>
#include <flexpm/kernel/parts/solid_patches.hpp>
#include <flexpm/kernel/parts/solid_plates.hpp>
#include <flexpm/kernel/topology/plate_build.hpp>

namespace yade {

namespace {

	flexpm::SolidJaw jawOf(const Vector3r& towards, Real ratio, Real angle, Real friction, Real strip)
	{
		return { fromYade(towards), ratio, angle, friction, strip };
	}

} // namespace

py::list GrainSolver::addSidePlates(int side, int pieces, bool bonded, Real friction, Real strip, bool seated)
{
	py::list numbers;
	for (int plate : flexpm::add_side_plates(assembly, side, pieces, { 0, friction, bonded, strip, seated }))
		numbers.append(plate);
	return numbers;
}

int GrainSolver::addTouchingPlate(Vector3r normal, Real friction)
{
	return flexpm::add_touching_plate(assembly, { normal[0], normal[1] }, { 0, friction, false });
}

int GrainSolver::addPatchPlate(Vector3r place, Real length, Vector3r normal, Real friction, bool bonded, Real strip, bool seated)
{
	return flexpm::add_patch_plate(assembly, { { place[0], place[1] }, length, { normal[0], normal[1] } }, { 0, friction, bonded, strip, seated });
}

int GrainSolver::findSidePlate(int side, bool bonded, Real friction, Real strip, bool seated)
{
	return flexpm::find_side_plate(current(), side, { 0, friction, bonded, strip, seated });
}

int GrainSolver::findPatchPlate(Vector3r place, Real length, Vector3r normal, Real friction, bool bonded, Real strip, bool seated)
{
	return flexpm::find_patch_plate(current(), { { place[0], place[1] }, length, { normal[0], normal[1] } }, { 0, friction, bonded, strip, seated });
}

int GrainSolver::addJawPlate(Vector3r place, Vector3r centre, Real radius, Real angle, Real friction, Real strip)
{
	return flexpm::add_jaw_plate(assembly, { { place[0], place[1] }, { centre[0], centre[1] }, radius, angle }, { 0, friction, false, strip });
}

int GrainSolver::findJawPlate(Vector3r place, Vector3r centre, Real radius, Real angle, Real friction, Real strip)
{
	return flexpm::find_jaw_plate(current(), { { place[0], place[1] }, { centre[0], centre[1] }, radius, angle }, { 0, friction, false, strip });
}

void GrainSolver::fixTangential(int plate) { flexpm::fix_tangential(assembly, plate); }

int GrainSolver::addWall(Vector3r position, Vector3r normal, Real friction)
{
	if (solid()) return flexpm::add_wall(space, fromYade(position), fromYade(normal), friction);
	return flexpm::add_wall(assembly, { position[0], position[1] }, { normal[0], normal[1] }, { 0, friction, false });
}

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
