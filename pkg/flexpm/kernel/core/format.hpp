// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Numbers in error messages.
#pragma once

#include <cstdio>
#include <string>

namespace flexpm {

/// Shortest common form with six digits: 0.004, 1.8e+14.
inline std::string number(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
}

}  // namespace flexpm
