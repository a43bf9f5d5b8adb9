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
		"Displays a :yref:`LaguerreCell`: its triangles filled, its outline, and its mesh on request; of a polyhedron its faces and edges, and the section where a plane "
		"cuts a 3D specimen. A scale next to the specimen shows the meaning of the colours. Faces of polyhedra are darker the more they face away, sections are not.",
		((bool, mesh, false,, "Display the edges of the triangles."))
		((Real, scale, 1.,, "Scale factor of the displacements [-]."))
		((string, colour, "shape",, "Quantity that colours a grain: ``shape``, the colour of its shape; ``stress_xx``, ``stress_yy`` or ``stress_xy``, in 3D also ``stress_zz``, ``stress_yz`` or ``stress_xz``, its mean stress (tension positive); "
			"``displacement`` of its centre; ``damage``, the mean over the points of its bonds; ``mineral``; ``fragment``, the largest pale. Any other word is ``shape``."))
		((bool, autoRange, true,, "Set :yref:`Gl1_LaguerreCell.range` to the smallest and largest value of each frame."))
		((Vector2r, range, Vector2r::Zero(),, "Values of both ends of the scale [Pa], [m] or [-]; next to the specimen they are in MPa and mm."))
		((Vector3r, cutNormal, Vector3r::Zero(),, "Normal of a plane that cuts a 3D specimen: grains and cracks beyond the plane are hidden, and the section is coloured like the grains. Zero: no plane."))
		((Real, cutOffset, 0.,, "Distance of that plane from the origin along the normal [m]."))
		((Vector3r, textColor, Vector3r::Ones(),, "Colour of the numbers of the scale: red, green and blue, 0 to 1."))
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
