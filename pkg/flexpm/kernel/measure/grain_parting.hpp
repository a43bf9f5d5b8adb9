// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  How far grains have parted from those that they were bonded to. SI units.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

namespace flexpm {

/// Largest growth of the distance between the centres of two grains that were bonded to each other,
/// whatever they do as one [m].
struct Parting {
    double any = 0.0;       ///< of all pairs that are there
    double standing = 0.0;  ///< of those of which neither has come loose
    int loose = 0;          ///< grains that have come loose, find_loose()
};

Parting find_parting(const Assembly& a);

}  // namespace flexpm
