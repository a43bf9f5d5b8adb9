// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Points, and discs of centres and radii, from Python's arrays.
#pragma once

#include <flexpm/kernel/core/vector.hpp>

#include <boost/python.hpp>

#include <vector>

namespace flexpm_bindings {

/// @param array  (n, 2) array [m], `name` in messages
/// @throws std::invalid_argument  if type or axes do not fit
std::vector<flexpm::Point> points(const boost::python::object& array, const char* name);

/// @param centres  (n, 2) array [m]
/// @param radii    (n,) array [m]
/// @throws std::invalid_argument  if type, axes or lengths do not fit
std::vector<flexpm::Disc> discs(const boost::python::object& centres, const boost::python::object& radii);

} // namespace flexpm_bindings
