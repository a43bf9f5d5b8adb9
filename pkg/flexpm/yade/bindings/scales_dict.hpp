// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Scales of a test for Python.
#pragma once

#include <flexpm/kernel/laboratory/loading_scales.hpp>

#include <boost/python.hpp>

namespace flexpm_bindings {

/// The scales by name: crossing_steps [-], modulus and strength [Pa], height and width [m], damage_share and failure_strain [-], lowest_strength [Pa].
inline boost::python::dict scales_dict(const flexpm::TestScales& scales)
{
	boost::python::dict d;
	d["crossing_steps"]  = scales.crossing_steps;
	d["modulus"]         = scales.modulus;
	d["strength"]        = scales.strength;
	d["height"]          = scales.height;
	d["width"]           = scales.width;
	d["damage_share"]    = scales.damage_share;
	d["failure_strain"]  = scales.failure_strain;
	d["lowest_strength"] = scales.lowest_strength;
	return d;
}

} // namespace flexpm_bindings
