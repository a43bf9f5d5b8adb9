// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Plates that scripts lay on a specimen in 2D.
#include <flexpm/yade/solver/GrainSolver.hpp>

#include <flexpm/kernel/parts/part_plates.hpp>
#include <flexpm/kernel/topology/plate_build.hpp>

namespace yade {

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
	return flexpm::add_wall(assembly, { position[0], position[1] }, { normal[0], normal[1] }, { 0, friction, false });
}

} // namespace yade
