// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  step.cpp without its variants for wider instruction sets, on one thread.
#include "support/baseline_step.hpp"

#include <flexpm/kernel/core/simd.hpp>
#include <flexpm/kernel/forces/contact_forces.hpp>

#undef FLEXPM_MULTIVERSION
#define FLEXPM_MULTIVERSION
#define update_contact_blocks baseline_update_contact_blocks
#define show_positions baseline_show_positions
#define step(assembly, options) baseline_step(assembly, options)
#include "../../../pkg/flexpm/kernel/step/step.cpp"
