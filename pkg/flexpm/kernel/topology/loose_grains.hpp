// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Grains that have come loose from a specimen, deviation D57: what presses on its sides
/// presses on them no more.
///
/// A pressure follows the facets that it acts on. On a grain that has lost its contacts it would go
/// on to act, also once the grain has turned round, and drive it away as a rocket; the skin of a
/// specimen in a cell does nothing of the kind.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>
#include <flexpm/kernel/assembly/solid_state.hpp>

namespace flexpm {

/// Find the grains that no chain of contacts, bonded or pressed anew, joins to what is held: nodes
/// whose velocity is given, and grains that touch a plate which moves at a given velocity. Where
/// nothing is held, to the largest group of grains. Without any pressure none is loose; in 3D
/// without gravity either.
template <class State> void find_loose(State& s);

extern template void find_loose(Assembly& s);
extern template void find_loose(SolidState& s);

}  // namespace flexpm
