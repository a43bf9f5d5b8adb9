// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Tetrahedra of polyhedral grains: each triangle of a face joined to the grain's centre.
#pragma once

#include <flexpm/kernel/space/polyhedra.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace flexpm {

/// Meshes of all grains; no node is shared between grains.
struct FanMeshes {
    std::vector<std::int64_t> node_offsets;  ///< first node of each grain, and the end
    std::vector<int>
        node_vertices;  ///< vertex of the cells at each node; -1: centre, the last of a grain
    std::vector<std::int64_t> element_offsets;
    std::vector<std::array<int, 4>> elements;  ///< nodes of the grain from 0, right-handed
    std::vector<double> volumes;               ///< of elements [m^3]
};

/// Fan of each cell about its centre.
/// @throws std::invalid_argument  if a tetrahedron has no volume: names the sphere
FanMeshes fan_meshes(const Polyhedra& cells);

}  // namespace flexpm
