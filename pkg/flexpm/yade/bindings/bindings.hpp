// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Functions that make the kernel known to Python; called once when the module _flexpm is loaded.
#pragma once

namespace flexpm_bindings {

/// AssemblyInput.
void register_assembly_bindings();

/// Outline, Tessellation, GrainMeshes; disc_count, disc_radii, insert_discs, tessellate, grain_meshes.
void register_geometry_bindings();

/// instruction_sets, instruction_set, use_instruction_set; give_back_memory.
void register_instruction_set_bindings();

/// StrainGauge; scales, stresses and end of a test.
void register_laboratory_bindings();

/// WeightedCells; weighted_cells, weights_of_volumes, cells_of_voxels, fit_labels.
void register_label_bindings();

/// Solid, Polyhedra, FanMeshes; sphere_count, insert_spheres, polyhedra, fan_meshes, face_point_counts.
void register_space_bindings();

/// PolygonOutline, Tiling; cells_in_outline, cells_of_polygons, cells_of_file, cut_by_joints.
void register_tiling_bindings();

/// InnerCells; inner_cells.
void register_subdivision_bindings();

} // namespace flexpm_bindings
