// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Deformable grains in YADE's 3D window.
#pragma once

#include <flexpm/yade/abi/yade_lite.hpp>

namespace yade {

class Gl1_LaguerreCell : public GlShapeFunctor {
public:
	~Gl1_LaguerreCell() override;
	void go(const shared_ptr<Shape>&, const shared_ptr<State>&, bool, const GLViewInfo&) override;
	RENDERS(LaguerreCell);
	// clang-format off
	YADE_CLASS_BASE_DOC_STATICATTRS(Gl1_LaguerreCell, GlShapeFunctor,
		"Draws a :yref:`LaguerreCell`: its triangles filled in the colour of the shape, its outline, and its mesh if asked.",
		((bool, mesh, false,, "Draw the triangles' edges."))
		((Real, scale, 1.,, "Displacements are drawn this many times larger [-]."))
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(Gl1_LaguerreCell);

} // namespace yade
