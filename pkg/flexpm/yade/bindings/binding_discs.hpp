// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Discs from Python's arrays of centres and radii.
#pragma once

#include <flexpm/kernel/core/vector.hpp>

#include <boost/python.hpp>

#include <vector>

namespace flexpm_bindings {

/// @param centres  (n, 2) array [m]
/// @param radii    (n,) array [m]
/// @throws std::invalid_argument  if type, axes or lengths do not fit
std::vector<flexpm::Disc> discs(const boost::python::object& centres, const boost::python::object& radii);

} // namespace flexpm_bindings
