// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  From polyhedral cells to the state of a bonded specimen in space. SI units.
#pragma once

#include <flexpm/kernel/assembly/solid_state.hpp>
#include <flexpm/kernel/space/face_points.hpp>
#include <flexpm/kernel/space/polyhedra.hpp>

namespace flexpm {

/// What the grains and their contacts are made of.
struct SolidInput {
    std::vector<ElasticMaterial> grains;  ///< kinds of grains
    /// Materials of contacts between two kinds, [first grain's kind][second grain's].
    std::vector<ContactMaterial> contacts;
    std::vector<int> kind;  ///< of each cell; empty: all are of the first
    FacePointRule rule = FacePointRule::corners_and_inner;
    bool rigid = false;
    /// Of each contact: factor of its strengths, see scaled_strength(); empty: all 1.
    std::vector<double> strength {};
    std::vector<ContactMaterial> joints {};  ///< strengths may be 0, see joint_law()
    /// Of each contact: index into `joints`, -1: none; empty: all -1.
    std::vector<int> joint {};
};

/// Specimen at rest, with real masses and the plan of a step. Grain g is cell g; blocks follow a
/// curve through space, so that neighbours lie near each other in memory.
///
/// @throws std::invalid_argument  if a property is out of range, a kind or joint is unknown, an element has
///         no volume, or a face has more corners than most_corners
SolidState make_solid(const Polyhedra& cells, const Solid& solid, const SolidInput& input);

}  // namespace flexpm
