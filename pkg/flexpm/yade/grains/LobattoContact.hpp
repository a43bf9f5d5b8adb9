// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Geometry and physics of a bond between two grains: handles to its points in the solver's packed arrays.
#pragma once

#include <flexpm/yade/abi/yade_lite.hpp>
#include <flexpm/yade/bindings/saved_class.hpp>
#include <flexpm/yade/grains/AssemblyOwner.hpp>

#include <atomic>

namespace yade {

class LobattoGeom : public ScGeom {
public:
	~LobattoGeom() override;

	// as the solver has them now; the members of the base are what mirrorBond() has written last
	Vector3r              presentNormal() const;
	Vector3r              presentContactPoint() const;
	Real                  presentPenetrationDepth() const;
	boost::python::object ends() const;
	boost::python::object corners() const;
	boost::python::object points() const;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(LobattoGeom, ScGeom,
		"Shared edge of two grains, or face of two polyhedra. Its state lives in :yref:`GrainSolver` and is read on access. :yref:`GrainSolver.mirrorBodies` writes the data "
		"of the :yref:`base<ScGeom>` for YADE's own functions, also whenever the simulation stops.",
		((int, contact, -1, Attr::readonly, "ID of the contact; it does not change, and no other contact gets it [-]."))
		, createIndex(); normal = contactPoint = Vector3r::Zero(); refR1 = refR2 = penetrationDepth = 0;
		, .add_property("normal", &LobattoGeom::presentNormal, "Unit normal from the first to the second grain, Eq. 5; in 3D the normal of the face (D66) [-].")
		.add_property("contactPoint", &LobattoGeom::presentContactPoint, "Middle of the edge, or centroid of the face [m].")
		.add_property("penetrationDepth", &LobattoGeom::presentPenetrationDepth, "Mean closure of the points [m]; negative if the bond has opened.")
		.add_property("ends", &LobattoGeom::ends, "Ends of the edge, (2, 2) [m]; a copy. Only in 2D.")
		.add_property("corners", &LobattoGeom::corners, "Corners of the face midway between both grains, counter-clockwise as seen from the second grain, (k, 3) [m]; a copy. Only in 3D.")
		.add_property("points", &LobattoGeom::points, "Positions of the points, (p, 3) [m]; a copy. Only in 3D.")
	);
	// clang-format on
	REGISTER_CLASS_INDEX(LobattoGeom, ScGeom);
};
REGISTER_SAVED(LobattoGeom);

class LobattoPhys : public NormShearPhys {
public:
	~LobattoPhys() override;

	Vector3r              presentNormalForce() const;
	Vector3r              presentShearForce() const;
	boost::python::object opening() const;
	boost::python::object slip() const;
	boost::python::object traction() const;
	boost::python::object damage() const;
	boost::python::object cracked() const;
	boost::python::object area() const;
	boost::python::object forces() const;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(LobattoPhys, NormShearPhys,
		"Points of a bond: from one end of the edge to the other in 2D; the corners and an inner point of the face in 3D. Its state lives in :yref:`GrainSolver`; arrays are read-only copies of it. :yref:`GrainSolver.mirrorBodies` writes the data "
		"of the :yref:`base<NormShearPhys>` for YADE's own functions, also whenever the simulation stops; kn and ks are the stiffnesses of the intact bond. "
		"Access to an erased bond raises an error.",
		((int, contact, -1, Attr::readonly, "ID of the contact; it does not change, and no other contact gets it [-]."))
		, createIndex();
		, .add_property("normalForce", &LobattoPhys::presentNormalForce, "Normal component of the force on the second grain [N].")
		.add_property("shearForce", &LobattoPhys::presentShearForce, "Shear component of the force on the second grain [N].")
		.add_property("opening", &LobattoPhys::opening, "Opening of each point, (p,) [m], negative in compression; a copy.")
		.add_property("area", &LobattoPhys::area, "Area of each point, (p,) [m^2]; a copy.")
		.add_property("slip", &LobattoPhys::slip, "Slip of each point along the tangent, (p,) [m]; in 3D along both tangents, (p, 2); a copy.")
		.add_property("traction", &LobattoPhys::traction, "Normal (tension positive) and shear traction, (p, 2) [Pa]; in 3D both shear components, (p, 3); a copy.")
		.add_property("damage", &LobattoPhys::damage, "Damage of each point, (p,) [-]; a copy.")
		.add_property("cracked", &LobattoPhys::cracked, "0 intact, 1 cracked in tension, 2 in shear, (p,); a copy.")
		.add_property("forces", &LobattoPhys::forces, "Force of each point on the second grain, (p, 3) [N]; a copy. Only in 3D.")
	);
	// clang-format on
	REGISTER_CLASS_INDEX(LobattoPhys, NormShearPhys);
};
REGISTER_SAVED(LobattoPhys);

/// Make the handles of a contact, by its number; reference radii are those of spheres with the grains' volumes.
void makeBond(const OwnedAssembly& owned, int contact, Interaction& interaction);

/// Write what YADE's own functions read of a bond into its handles, by the contact's place in the arrays.
void mirrorBond(const OwnedAssembly& owned, int place, LobattoGeom& geom, LobattoPhys& phys);

/// Write numbers that are none instead: the handles would be older than the arrays.
void hideBond(LobattoGeom& geom, LobattoPhys& phys);

/// Counts the handles of bonds and grains that have been destroyed; the solver looks for erased ones when it has changed.
std::atomic<long>& destroyedContacts();

} // namespace yade
