// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/yade/solver/SolidSolver.hpp>

namespace yade {

YADE_PLUGIN((SolidSolver));

SolidSolver::~SolidSolver() = default;

} // namespace yade
