// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  From a tessellation to the packed, bonded, unloaded assembly, paper Sec. 2.3 and 3.1.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>
#include <flexpm/kernel/fem/grain_mesh.hpp>
#include <flexpm/kernel/geometry/cells.hpp>

#include <cstdint>

namespace flexpm {

struct AssemblyOptions {
    double thickness = 0.0;  ///< [m]
    bool rigid = false;  ///< grains that move as one body; `mesh` and Young's modulus do not matter
    MeshKind mesh = MeshKind::refined;
    int points = 3;               ///< contact points: 3 or 2 (Lobatto), 1 (middle of the edge)
    bool on_centre_line = false;  ///< with one point: where Eq. 7 puts it for d_v = 0 (PCM variant)
    std::vector<ElasticMaterial> elastic;
    std::vector<int> grain_material;  ///< per cell, into `elastic`; empty: all 0
    std::vector<int> parent;          ///< per cell: its grain of the rock; empty: itself
    std::vector<int>
        edge_law;  ///< per shared edge, into `laws`; empty: by the materials of its cells
    /// Per shared edge: 1 takes the normal of the edge, 0 that between the centres. Empty: between
    /// two whole Laguerre cells that between the centres, else that of the edge. Deviation D104.
    std::vector<std::uint8_t> edge_normal;
    std::vector<ContactMaterial> laws;  ///< per pair of materials: laws[i * elastic.size() + j]
    std::vector<int>
        edge_joint;  ///< per shared edge, into `joints`, -1: none; empty: all -1. An edge with a
                     ///< joint takes its law and the normal of the edge
    std::vector<double>
        edge_strength;  ///< per shared edge: factor of its strengths, see scaled_strength();
                        ///< empty: all 1
    std::vector<ContactMaterial> joints;  ///< strengths may be 0, see joint_law()
};

/// @throws std::invalid_argument  if an option is out of range
Assembly make_assembly(
    const Tessellation& t, const std::vector<Disc>& discs, const AssemblyOptions& options);

}  // namespace flexpm
