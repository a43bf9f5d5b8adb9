// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Fixed connectivities of the finite element mesh inside a grain, paper Sec. 2.2, Fig. 1.
#pragma once

#include <flexpm/kernel/core/vector.hpp>

#include <array>
#include <vector>

namespace flexpm {

/// Kind of the mesh inside a grain: triangles from the centre, or one ring of inner nodes more.
enum class MeshKind { fan, refined };

using Triangle = std::array<int, 3>;  ///< node numbers, counter-clockwise

/// Connectivity that all grains with the same number of corners share.
/// Nodes: 0 .. vertices - 1 the corners, `vertices` the centre, then the inner nodes.
struct MeshTemplate {
    int vertices = 0;
    int nodes = 0;
    std::vector<Triangle> triangles;
};

/// Template of a kind: a fan has V + 1 nodes and V triangles, a refined mesh 2 V nodes and 3 V - 2
/// triangles.
///
/// In the refined mesh the V - 1 inner nodes are the polygon at half size, the images of the edge
/// from corner V - 1 to corner 0 merged into one node: one triangle stands on that edge, two on
/// each other edge, V - 1 meet in the centre. A triangle (V = 3) has its own pattern.
///
/// @param vertices  V >= 3
const MeshTemplate& mesh_template(int vertices, MeshKind kind);

/// Positions of all nodes of the template, in its order, for corners in its order.
std::vector<Point> template_nodes(const std::vector<Point>& corners, Point centre, MeshKind kind);

}  // namespace flexpm
