// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Shape of a deformable grain: a handle to its nodes in the solver's packed arrays.
#pragma once

#include <flexpm/yade/abi/yade_lite.hpp>
#include <flexpm/yade/bindings/saved_class.hpp>

namespace yade {

class LaguerreCell : public Shape {
public:
	~LaguerreCell() override;

	boost::python::object positions() const;
	boost::python::object displacements() const;
	boost::python::object velocities() const;
	boost::python::object forces() const;
	boost::python::object held() const;
	boost::python::list   triangles() const;
	boost::python::list   tetrahedra() const;
	int                   vertices() const;
	bool                  rigid() const;
	int                   parentGrain() const;
	void                  setMotion(Vector3r velocity, Real spin) const;
	void                  setSpaceMotion(Vector3r velocity, Vector3r spin) const;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(LaguerreCell, Shape,
		"Grain meshed with constant-strain triangles, or tetrahedra in 3D. Its state lives in :yref:`GrainSolver`; the arrays are views "
		"of it (no copy), valid until the solver assembles or loads another specimen. Nodes are numbered corners first "
		"(counter-clockwise in 2D), then the centre, then the inner ring. Vectors have d components, 2 or 3.",
		((int, grain, -1, Attr::readonly, "Index of the grain in the solver [-]."))
		, createIndex();
		, .add_property("positions", &LaguerreCell::positions, "Node positions, (n, d) [m]; read-only, a copy in 3D.")
		.add_property("displacements", &LaguerreCell::displacements, "Node displacements from the bonded state, (n, d) [m]; of a rigid polyhedron a copy, read-only.")
		.add_property("velocities", &LaguerreCell::velocities, "Node velocities, (n, d) [m/s, or m per step with scaled masses]; of a rigid polyhedron a copy, read-only.")
		.add_property("forces", &LaguerreCell::forces, "Nodal forces of the last step without damping, (n, d) [N]; of a rigid polyhedron a copy, in which the centre has the sum of all other forces.")
		.add_property("held", &LaguerreCell::held, "1 where the velocity component is prescribed, (n, d) [-]; of a rigid grain only the row of the centre counts.")
		.add_property("triangles", &LaguerreCell::triangles, "Node indices of each triangle, counter-clockwise; of a polyhedron the triangles of its faces, seen from outside.")
		.add_property("tetrahedra", &LaguerreCell::tetrahedra, "Node indices of each tetrahedron, the centre first; empty in 2D.")
		.add_property("vertices", &LaguerreCell::vertices, "Number of corners; also the index of the centre node [-].")
		.add_property("rigid", &LaguerreCell::rigid, "The grain is rigid; its nodes follow the centre.")
		.add_property("parentGrain", &LaguerreCell::parentGrain, "Index of the rock grain to which the cell belongs: the grain itself, or the grain of which it is an inner particle [-].")
		.def("setMotion", &LaguerreCell::setMotion, (boost::python::arg("velocity"), boost::python::arg("spin")),
			"Set the velocity of the centre [m/s, or m per step with scaled masses] and the angular velocity [rad/s, or rad per step] of a rigid grain; "
			"the velocities of its nodes follow.")
		.def("setMotion", &LaguerreCell::setSpaceMotion, (boost::python::arg("velocity"), boost::python::arg("spin")),
			"Set the velocity of the centre and the angular velocity, a vector, of a rigid polyhedron; units as above.")
	);
	// clang-format on
	REGISTER_CLASS_INDEX(LaguerreCell, Shape);
};
REGISTER_SAVED(LaguerreCell);

} // namespace yade
