// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Deformable grains in YADE's 3D window.
#pragma once

#include <flexpm/kernel/view/solid_faces.hpp>
#include <flexpm/yade/abi/yade_lite.hpp>
#include <flexpm/yade/bindings/saved_class.hpp>

namespace yade {

class Gl1_LaguerreCell : public GlShapeFunctor {
public:
	~Gl1_LaguerreCell() override;
	void go(const shared_ptr<Shape>&, const shared_ptr<State>&, bool, const GLViewInfo&) override;
	RENDERS(LaguerreCell);
	// clang-format off
	YADE_CLASS_BASE_DOC_STATICATTRS(Gl1_LaguerreCell, GlShapeFunctor,
		"Draws a :yref:`LaguerreCell`: its triangles filled, its outline, and its mesh if asked; of a polyhedron its faces and edges, and the section where a plane "
		"lays a solid open. A scale beside the specimen says what the colours stand for; faces of solids are darker the more they are turned away, sections are not.",
		((bool, mesh, false,, "Draw the triangles' edges."))
		((Real, scale, 1.,, "Displacements are drawn this many times larger [-]."))
		((string, colour, "shape",, "What colours a grain: ``shape``, the colour of its shape; ``stress_xx``, ``stress_yy`` or ``stress_xy``, of solids also ``stress_zz``, ``stress_yz`` or ``stress_xz``, its mean stress (tension positive); "
			"``displacement`` of its centre; ``damage``, the mean over the points of its bonds; ``mineral``; ``fragment``, the largest pale. Any other word is ``shape``."))
		((bool, autoRange, true,, "Set :yref:`Gl1_LaguerreCell.range` to the least and the largest value of each picture."))
		((Vector2r, range, Vector2r::Zero(),, "Values of both ends of the scale [Pa], [m] or [-]; beside the specimen they stand in MPa and mm."))
		((Vector3r, cutNormal, Vector3r::Zero(),, "Normal of a plane that lays a solid open: what lies beyond the plane is not drawn, nor are cracks there, and the section is coloured as the grains. Zero: no plane."))
		((Real, cutOffset, 0.,, "Distance of that plane from the origin along the normal [m]."))
		((Vector3r, textColor, Vector3r::Ones(),, "Colour of the scale's numbers: red, green and blue, 0 to 1."))
	);
	// clang-format on

	/// The plane as the kernel takes it.
	static flexpm::CutPlane cut();
	/// Part of the light that a face of a solid has: all if it faces the viewer.
	static Real light(const flexpm::Polygon& corners, const Vector3r& toViewer);
	/// Direction to the viewer in the scene, from what OpenGL draws with.
	static Vector3r toViewer();
	static void     setColour(const Vector3r& colour);
};
REGISTER_SAVED(Gl1_LaguerreCell);

} // namespace yade
