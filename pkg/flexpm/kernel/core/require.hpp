// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Errors of the kernel: one line that names quantity, value and unit, rule and remedy.
#pragma once

#include <flexpm/kernel/core/vector.hpp>

#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace flexpm {

/// Text of a number with at most twelve digits: 0.004, 1.8e+14.
inline std::string number(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.12g", value);
    return text;
}

/// A place in an error message, with its unit.
inline std::string place(Point p) { return "(" + number(p.x) + ", " + number(p.y) + ") m"; }
inline std::string place(Vector p)
{
    return "(" + number(p.x) + ", " + number(p.y) + ", " + number(p.z) + ") m";
}

/// One line of an error message.
inline std::string statement(
    const std::string& quantity, const std::string& value, const std::string& rule)
{
    return quantity + " = " + value + ", " + rule;
}

/// Refuse a value that was given.
/// @param value  with its unit
/// @param rule   which the value breaks, and what to do
/// @throws std::invalid_argument  always
[[noreturn]] inline void refuse(
    const std::string& quantity, const std::string& value, const std::string& rule)
{
    throw std::invalid_argument(statement(quantity, value, rule));
}

[[noreturn]] inline void refuse(
    const std::string& quantity, double value, const char* unit, const std::string& rule)
{
    refuse(quantity, number(value) + (*unit ? " " : "") + unit, rule);
}

/// Report a value that came out of a calculation.
/// @throws std::runtime_error  always
[[noreturn]] inline void fail(
    const std::string& quantity, const std::string& value, const std::string& rule)
{
    throw std::runtime_error(statement(quantity, value, rule));
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

}  // namespace flexpm
