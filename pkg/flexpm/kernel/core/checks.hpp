// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Checks of input values: one line that names quantity, value, rule and remedy.
#pragma once

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

namespace flexpm {

[[noreturn]] inline void refuse(
    const std::string& quantity, double value, const char* unit, const std::string& rule)
{
    std::ostringstream text;
    text.precision(12);
    text << quantity << " = " << value << (*unit ? " " : "") << unit << ", " << rule;
    throw std::invalid_argument(text.str());
}

inline void check_finite(const std::string& quantity, double value, const char* unit)
{
    if (!std::isfinite(value)) refuse(quantity, value, unit, "must be a finite number");
}

inline void check_positive(const std::string& quantity, double value, const char* unit)
{
    if (!(std::isfinite(value) && value > 0.0)) refuse(quantity, value, unit, "must be above 0");
}

inline void check_not_negative(const std::string& quantity, double value, const char* unit)
{
    if (!(std::isfinite(value) && value >= 0.0)) {
        refuse(quantity, value, unit, "must not be below 0");
    }
}

inline void check_at_least(
    const std::string& quantity, double value, double least, const char* unit)
{
    if (value >= least) return;
    std::ostringstream rule;
    rule.precision(12);
    rule << "below the elastic energy at the strength; give at least " << least << ' ' << unit;
    refuse(quantity, value, unit, rule.str());
}

}  // namespace flexpm
