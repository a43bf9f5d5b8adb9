// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Lines by which a window shows contacts: cracked parts of their edges, and branches.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

namespace flexpm {

struct Line {
    Point from;  ///< [m]
    Point to;    ///< [m]
};

/// Part of a contact's edge that a point stands for, where displacements are drawn `factor` times
/// larger.
Line point_line(const Assembly& a, int contact, int point, double factor);

/// Between the centres of both grains, likewise.
Line branch_line(const Assembly& a, int contact, double factor);

}  // namespace flexpm
