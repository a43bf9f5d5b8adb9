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
		"Displays the cracks and the force of a :yref:`LobattoPhys` if ``yade.qt.Renderer().intrPhys`` is set. :yref:`Gl1_LaguerreCell.scale` also scales the displacements here. "
		"In 3D grains hide the bonds behind them: :yref:`Gl1_LaguerreCell.cutNormal` cuts the specimen, and without ``yade.qt.Renderer().shape`` only cracks and forces are displayed.",
		((bool, cracks, true,, "Display the part of the edge or face of each cracked point: blue if it cracked in tension, orange in shear."))
		((bool, forces, false,, "Display the normal force as a line between the centres: black in compression, red in tension; the width is proportional to the force."))
		((Real, crackWidth, 3.,, "Width of a crack [pixel]."))
		((Real, forceWidth, 8.,, "Width of the largest force [pixel]."))
	);
	// clang-format on
};
REGISTER_SAVED(Gl1_LobattoPhys);

} // namespace yade
