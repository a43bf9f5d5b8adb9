// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The former name of the solver of solids.
#pragma once

#include <flexpm/yade/solver/GrainSolver.hpp>

namespace yade {

class SolidSolver : public GrainSolver {
public:
	~SolidSolver() override;

	YADE_CLASS_BASE_DOC(SolidSolver, GrainSolver, "Name of the 3D :yref:`GrainSolver` until version 0.4.");
};
REGISTER_SAVED(SolidSolver);

} // namespace yade
