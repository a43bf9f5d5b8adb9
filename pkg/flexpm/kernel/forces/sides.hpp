// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Sides of a specimen: nodes of prescribed velocity, reactions, mean displacements,
/// pressure, paper Sec. 4.1. Components: 0 = x, 1 = y.
#pragma once

#include <flexpm/kernel/assembly/assembly.hpp>

#include <vector>

namespace flexpm {

/// Sides of a rectangle, in the order of its outline.
enum RectangleSide { bottom_side = 0, right_side = 1, top_side = 2, left_side = 3 };

/// @throws std::invalid_argument  if no facet of the specimen as built lies on the side
void require_side(const Assembly& a, int side);

/// Whether a facet lies on a side, its grain not erased.
bool is_on_side(const Assembly& a, int facet, int side);

/// Whether any does.
bool has_facets(const Assembly& a, int side);

/// Offsets of the nodes on one side of the outline, ascending, each once; not those of erased
/// grains.
/// @throws std::invalid_argument  as require_side()
std::vector<int> side_nodes(const Assembly& a, int side);

/// Prescribe one velocity component of the nodes [m/s].
void prescribe(Assembly& a, const std::vector<int>& nodes, int axis, double velocity);

/// After velocities were prescribed between two steps: what the present forces work in the half
/// step that follows goes with the new velocities, see integrate_one().
void update_prescribed_work(Assembly& a, double dt);

/// Integrate the component again, from the velocity it has.
void release(Assembly& a, const std::vector<int>& nodes, int axis);

/// Force that the holder exerts on the nodes [N]: minus the sum of the nodal forces.
double reaction(const Assembly& a, const std::vector<int>& nodes, int axis);

/// Mean displacement of a side, weighted by length of facets, where nodes move so, in the layout of
/// Grains::displacement [m].
double side_displacement(const Assembly& a, int side, int axis, const Array<double>& moved);

/// Reference length of a side, with the facets of erased grains: stresses refer to the whole
/// specimen [m].
double side_length(const Assembly& a, int side);

/// Pressure on a side, on the deformed facets, compressive positive [Pa]. It acts on grains that
/// are not loose.
/// @throws std::invalid_argument  if no facet lies on the side, or the pressure is below 0
void set_pressure(Assembly& a, int side, double pressure);

/// Update the pressure forces on block `block` of facets, at the positions reached at the
/// end of the step `dt`; returns their work [J].
double update_facet_block(Assembly& a, int block, double dt);

}  // namespace flexpm
