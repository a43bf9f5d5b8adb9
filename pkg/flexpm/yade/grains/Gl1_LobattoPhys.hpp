// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Cracks and contact forces in YADE's 3D window.
#pragma once

#include <flexpm/yade/abi/yade_lite.hpp>
#include <flexpm/yade/bindings/saved_class.hpp>

namespace yade {

class Gl1_LobattoPhys : public GlIPhysFunctor {
public:
	~Gl1_LobattoPhys() override;
	void go(const shared_ptr<IPhys>&, const shared_ptr<Interaction>&, const shared_ptr<Body>&, const shared_ptr<Body>&, bool) override;
	RENDERS(LobattoPhys);
	// clang-format off
	YADE_CLASS_BASE_DOC_STATICATTRS(Gl1_LobattoPhys, GlIPhysFunctor,
		"Draws the cracks and the force of a :yref:`LobattoPhys`, where ``yade.qt.Renderer().intrPhys`` is set. Displacements are as large as :yref:`Gl1_LaguerreCell.scale` makes them. "
		"In a solid grains hide what lies behind them: :yref:`Gl1_LaguerreCell.cutNormal` lays it open, and without ``yade.qt.Renderer().shape`` there are cracks and forces alone.",
		((bool, cracks, true,, "Draw the part of the edge or the face that each cracked point stands for: blue if it cracked in tension, orange in shear."))
		((bool, forces, false,, "Draw the normal force as a line between the centres: black in compression, red in tension, as wide as it is large."))
		((Real, crackWidth, 3.,, "Width of a crack [pixel]."))
		((Real, forceWidth, 8.,, "Width of the largest force [pixel]."))
	);
	// clang-format on
};
REGISTER_SAVED(Gl1_LobattoPhys);

} // namespace yade
