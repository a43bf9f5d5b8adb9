// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Lines by which a window shows cracked parts of contacts in 2D.
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

}  // namespace flexpm
