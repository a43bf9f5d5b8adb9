// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The kernel's step compiled a second time, for the plainest instruction set alone.
#pragma once

#include <flexpm/kernel/forces/contact_forces.hpp>
#include <flexpm/kernel/step/step.hpp>

namespace flexpm {

void baseline_step(Assembly& a, const StepOptions& options);

void baseline_update_contact_blocks(Assembly& a, int first, int end, double dt);

}  // namespace flexpm
