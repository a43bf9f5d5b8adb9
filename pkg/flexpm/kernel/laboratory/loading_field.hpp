// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The motion that a loading gives to a specimen: the elastic solution at its present velocity, deviation D30.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

namespace flexpm {

/// Velocities of all nodes in that motion, in the layout of Grains::displacement; held and driven nodes have their own [m/s].
Array<double> loading_field(const Assembly& a);

}  // namespace flexpm
