// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Geometry and physics of a bond between two grains: handles to its points in the solver's packed arrays.
#pragma once

#include <flexpm/yade/abi/yade_lite.hpp>

#include <atomic>

namespace yade {

class LobattoGeom : public IGeom {
public:
	~LobattoGeom() override;

	Vector3r              normal() const;
	Vector3r              contactPoint() const;
	boost::python::object ends() const;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(LobattoGeom, IGeom,
		"Shared edge of two grains. Its state lives in :yref:`GrainSolver`.",
		((int, contact, -1, Attr::readonly, "Number of the contact: it keeps it, and no other contact gets it [-]."))
		, createIndex();
		, .add_property("normal", &LobattoGeom::normal, "Unit normal from the first to the second grain, Eq. 5 [-].")
		.add_property("contactPoint", &LobattoGeom::contactPoint, "Middle of the edge [m].")
		.add_property("ends", &LobattoGeom::ends, "Ends of the edge, (2, 2) [m]; a copy.")
	);
	// clang-format on
	REGISTER_CLASS_INDEX(LobattoGeom, IGeom);
};
REGISTER_SERIALIZABLE(LobattoGeom);

class LobattoPhys : public IPhys {
public:
	~LobattoPhys() override;

	boost::python::object opening() const;
	boost::python::object slip() const;
	boost::python::object traction() const;
	boost::python::object damage() const;
	boost::python::object cracked() const;
	boost::python::object area() const;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(LobattoPhys, IPhys,
		"Points of a bond, from one end of the edge to the other. Its state lives in :yref:`GrainSolver`; arrays are read-only copies of it. "
		"A kept handle of an erased bond raises an error.",
		((int, contact, -1, Attr::readonly, "Number of the contact: it keeps it, and no other contact gets it [-]."))
		, createIndex();
		, .add_property("opening", &LobattoPhys::opening, "Opening of each point, (p,) [m], compression below 0; a copy.")
		.add_property("area", &LobattoPhys::area, "Area of each point, (p,) [m^2]; a copy.")
		.add_property("slip", &LobattoPhys::slip, "Slip of each point along the tangent, (p,) [m]; a copy.")
		.add_property("traction", &LobattoPhys::traction, "Normal (tension positive) and shear traction, (p, 2) [Pa]; a copy.")
		.add_property("damage", &LobattoPhys::damage, "Damage of each point, (p,) [-]; a copy.")
		.add_property("cracked", &LobattoPhys::cracked, "0 intact, 1 cracked in tension, 2 in shear, (p,); a copy.")
	);
	// clang-format on
	REGISTER_CLASS_INDEX(LobattoPhys, IPhys);
};
REGISTER_SERIALIZABLE(LobattoPhys);

/// Counts the handles of bonds and grains that have been destroyed; the solver looks for erased ones when it has changed.
std::atomic<long>& destroyedContacts();

} // namespace yade
