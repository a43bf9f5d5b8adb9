// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  What Python gives to assemble grains, but their materials: cells, discs and how they are bonded.
#pragma once

#include <flexpm/kernel/topology/assembly_build.hpp>

#include <boost/python.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace flexpm_bindings {

/// AssemblyInput of Python, whose members binding_assembly.cpp names and explains.
struct AssemblyInput {
	std::shared_ptr<flexpm::Tessellation> tessellation;
	std::vector<flexpm::Disc>             discs;
	flexpm::AssemblyOptions               options; ///< without what comes from materials
	/// Per shared edge: 1 between two grains of the rock, 0 within one, where a contact is elastic; empty: all 1.
	std::vector<std::uint8_t> outer;
	bool                      edgeNormals = false; ///< outer contacts take the normal of their edge
};

/// @throws std::invalid_argument  for another name than fan or refined, with that of the quantity
flexpm::MeshKind meshKind(const std::string& quantity, const std::string& name);

} // namespace flexpm_bindings
