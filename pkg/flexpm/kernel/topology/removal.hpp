// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Grains and contacts that are taken out of a running assembly. Their rows stay, without
/// effect.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

namespace flexpm {

/// Take away what a contact carries; its stored energy leaves the system with it.
void remove_contact(Contacts& contacts, int contact);

/// Let a grain stand still, without mass, exert nothing and take no load any more; plates forget
/// its edges, and node sets its nodes. Its contacts are not touched.
void remove_grain(Assembly& a, int grain);

}  // namespace flexpm
