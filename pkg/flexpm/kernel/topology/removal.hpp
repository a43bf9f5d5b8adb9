// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Grains and contacts that are taken out of a running assembly. Their rows stay, without effect.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

namespace flexpm {

/// The contact carries nothing any more; its stored energy leaves the system with it.
void retire_contact(Assembly& a, int contact);

/// The grain stands still, exerts nothing, and is not loaded any more. Its contacts are not touched.
void retire_grain(Assembly& a, int grain);

}  // namespace flexpm
