// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Points of plates: what a plate says of them itself, in 2D and in 3D alike. SI units;
/// forces are those on the specimen.
#pragma once

#include <flexpm/kernel/assembly/parts.hpp>

#include <array>
#include <vector>

namespace flexpm {

/// Number of the points of a plate, those that do not touch included.
inline int plate_points(const Plate& p) { return static_cast<int>(p.points.size()); }

/// Share of a corner of its triangle in a point.
inline double corner_share(const Plate& p, int index, int corner)
{
    return p.points[index].weights[corner];
}

inline bool is_jaw(const Plate& p) { return p.jaw_radius > 0.0; }

/// Into the specimen at a point, a unit vector; of a jaw the point's own.
inline Vector point_normal(const Plate& p, int index) { return p.points[index].normal; }

/// Axes of the face at a point with this normal: in 2D the first lies in the plane, the normal
/// turned counter-clockwise.
std::array<Vector, 2> face_axes(Vector normal);

/// What the face of a plate with a seat goes along its normal at a point by each component of a
/// turn [m], whether the seat is held or not; nought without a seat.
inline Vector seat_arm(const Plate& p, int index) { return p.points[index].arm; }

/// The same of a plate that turns freely; nought of others.
inline Vector point_arm(const Plate& p, int index)
{
    return p.seated ? seat_arm(p, index) : Vector {};
}

/// Gap of a point at a displacement from its reference, relative to its plate [m].
inline double gap_after(const Plate& p, int index, Vector way)
{
    const PlatePoint& point = p.points[index];
    return point.gap + dot(point.normal, way) - dot(point_arm(p, index), p.turn);
}

/// Stiffness of a point along its normal [N/m].
inline double point_stiffness(const Plate& p, int i) { return p.stiffness * p.points[i].area; }

/// The same along the face; 0: it is smooth [N/m].
inline double sliding_stiffness(const Plate& p, int index)
{
    return p.friction > 0.0 ? p.shear_stiffness * p.points[index].area : 0.0;
}

/// Force of a point along its normal at a gap [N].
inline double normal_force(const Plate& p, int index, double gap)
{
    return gap < 0.0 || p.bonded ? -point_stiffness(p, index) * gap : 0.0;
}

/// The same at the last step.
inline double point_push(const Plate& p, int index)
{
    return normal_force(p, index, p.points[index].opening);
}

/// Least gap of the points of a plate at the reference; infinite without any [m].
double least_gap(const Plate& p);

/// Force of a point along the face at the last step [N].
Vector point_shear(const Plate& p, int index);

/// Force of a point at the last step [N].
Vector point_force(const Plate& p, int index);

/// Stored in the points of a plate [J].
double elastic_energy(const Plate& p);

/// Area on which a plate presses [m^2].
double pressed_area(const Plate& p);

/// Displacement of the crosshead behind a plate, or its own without a machine [m].
inline Vector crosshead_displacement(const Plate& p)
{
    return p.displacement + p.machine_give * p.normal;
}

/// Stored in the spring of the machine [J]. What the crosshead works is the plate's work on the
/// specimen and what this grows by.
inline double machine_energy(const Plate& p)
{
    return 0.5 * p.machine_stiffness * p.machine_give * p.machine_give;
}

/// Whether its place in a step follows from its points: by its machine or by its seat.
inline bool is_soft(const Plate& p) { return p.seated || p.machine_stiffness > 0.0; }

/// Whether the spring of a machine gives way behind a plate: one that a load moves has no use of it.
inline bool gives_way(const Plate& p) { return p.machine_stiffness > 0.0 && !p.loaded; }

/// Number of the plate that was laid as this one; -1 if there is none. A stiffness of its own is
/// not looked at.
int find_alike(const std::vector<Plate>& plates, const Plate& plate);

}  // namespace flexpm
