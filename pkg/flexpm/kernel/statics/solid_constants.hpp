// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Young's modulus and Poisson's ratio of a solid by one static solve with conjugate
/// gradients. SI units.
#pragma once

#include <flexpm/kernel/space/face_points.hpp>
#include <flexpm/kernel/space/polyhedra.hpp>

#include <utility>
#include <vector>

namespace flexpm {

/// What grains and their contacts are made of, as far as it is elastic.
struct SolidElasticity {
    double young = 0.0;             ///< of the grains [Pa], > 0
    double poisson = 0.0;           ///< of the grains [-], 0 < nu < 0.5
    double normal_stiffness = 0.0;  ///< K_n of the contacts [Pa/m], > 0
    double shear_ratio = 0.0;       ///< eta = k_s / k_n [-], > 0
};

/// The same of grains of several kinds.
struct SolidElasticities {
    /// Contacts between two kinds, [first grain's kind][second grain's]; grains of a kind have
    /// `young` and `poisson` of the kind's own contacts.
    std::vector<SolidElasticity> pairs;
    std::vector<int> kind;  ///< of each cell; empty: all are of the first

    SolidElasticities(const SolidElasticity& alike) : pairs { alike } { }
    SolidElasticities(std::vector<SolidElasticity> of_pairs, std::vector<int> of_cells) :
        pairs(std::move(of_pairs)),
        kind(std::move(of_cells))
    {
    }
};

/// Elastic constants of a solid as a whole, and how they were found.
struct SolidConstants {
    double youngs_modulus;  ///< [Pa]
    double poissons_ratio;  ///< [-], of the mean of both lateral strains
    int iterations;         ///< of conjugate gradients
    double residual;        ///< of the nodal forces, relative to those of the load [-]
};

/// A solid at an axial strain of 1, as the linear solution has it.
struct SolidExtension {
    SolidConstants constants;
    /// Displacements of the nodes, grain after grain in the order of fan_meshes() [m].
    std::vector<Vector> field;
};

/// Test a solid of deformable bonded grains in uniaxial tension along z: nodes of bottom and top
/// are held and moved axially only. The modulus follows from the top's reaction over the section,
/// Poisson's ratio from the way of the mantle along its normal.
///
/// Small strains, intact contacts. No matrix is stored, so memory grows with the grains alone; sums
/// have a fixed order and one thread, so results have the same bits everywhere.
///
/// @param cells  of `solid`
/// @throws std::invalid_argument  for a property out of range, a kind that is not there, a solid
///         without bottom or top, or cells that are not its own
/// @throws std::runtime_error     if the forces do not come to balance
SolidExtension solid_extension(const Polyhedra& cells, const Solid& solid,
    const SolidElasticities& materials, FacePointRule rule = FacePointRule::corners_and_inner);

/// The constants alone.
SolidConstants solid_constants(const Polyhedra& cells, const Solid& solid,
    const SolidElasticities& materials, FacePointRule rule = FacePointRule::corners_and_inner);

}  // namespace flexpm
