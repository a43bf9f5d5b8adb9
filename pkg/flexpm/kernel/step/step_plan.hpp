// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Building the plan of a step.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

namespace flexpm {

/// Build all of Assembly::plan but the positions that scripts are shown. Whoever makes or loads an
/// assembly, or changes its contacts or edges, calls it before the next step; what elements add to
/// the stiffness bound is kept if it is known.
void prepare_step(Assembly& a);

}  // namespace flexpm
