// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  A specimen as a textbook would write it down: lists of grains, nodes, contacts and
/// points, each with its own numbers. SI units, tension and opening positive, rotations
/// counter-clockwise.
#pragma once

#include <flexpm/kernel/core/vector.hpp>
#include <flexpm/kernel/law/bilinear.hpp>
#include <flexpm/kernel/law/elastic.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace plain {

using flexpm::Point;

struct Node {
    Point reference;                      ///< place when bonded [m]
    Point displacement;                   ///< since then [m]
    Point velocity;                       ///< half a step after the displacement [m/s]
    Point undamped_velocity;              ///< part of it that is not damped [m/s]
    Point force;                          ///< of the last step, without damping [N]
    bool held_x = false, held_y = false;  ///< the velocity is given
    double inverse_mass = 0.0;            ///< 0: follows a rigid grain [1/kg]

    double largest_part = 0.0;  ///< of what makes up `force`, before it cancels [N]

    void push(Point part)
    {
        force = force + part;
        largest_part = std::max({ largest_part, std::fabs(part.x), std::fabs(part.y) });
    }
    Point place() const { return reference + displacement; }
};

struct Grain {
    std::vector<int> nodes;  ///< corners, centre, inner nodes
    int centre = 0;          ///< one of them
    std::vector<std::array<int, 3>>
        triangles;  ///< nodes, counter-clockwise; none: the grain is rigid
    flexpm::ElasticMaterial elastic;

    // rigid grains
    double angle = 0.0;            ///< turned since the reference [rad]
    double spin = 0.0;             ///< half a step later [rad/s]
    double undamped_spin = 0.0;    ///< part of it that is not damped [rad/s]
    bool spin_held = false;        ///< the spin is given
    double inverse_inertia = 0.0;  ///< [1/(kg m^2)]

    bool is_rigid() const { return triangles.empty(); }
};

struct ContactPoint {
    double weight[2] = { 0.0, 0.0 };  ///< on the edges of a and b: share of the second node [-]
    double area = 0.0;                ///< [m^2]
    flexpm::PointState state;
    double paired_slip = 0.0;  ///< at which its places on the edges lay opposite [m]
    double crack_slip = 0.0;   ///< plastic slip since the crack, of a law whose friction falls [m]
    int crack_step = -1;
    int crack_mode = 0;
    Point crack_place;
    double doubt =
        1.0;  ///< distance of the last step from a jump of the law, see point_law.hpp [-]
};

struct Contact {
    std::array<int, 2> grains;
    std::array<int, 2> edge[2];  ///< nodes of the edge of a and of b
    bool across_edges = false;   ///< the normal is that of the edges, not of the centres
    Point branch;  ///< what has the direction of the normal before the centres move [m]
    Point normal;  ///< unit vector from a to b
    double per_length[2] = { 0.0, 0.0 };  ///< 1 / length of each edge along the tangent [1/m]
    flexpm::LawParameters law;
    std::vector<ContactPoint> points;
    bool active = true;  ///< has not been removed
};

struct BoundaryEdge {
    std::array<int, 2> nodes;  ///< counter-clockwise in the grain
    double pressure = 0.0;     ///< compressive positive [Pa]
};

struct PlatePoint {
    std::array<int, 2> nodes;  ///< of the boundary edge
    double weight = 0.0;       ///< share of the second node [-]
    double area = 0.0;         ///< [m^2]
    double gap = 0.0;          ///< at the reference [m]
    double shear_force = 0.0;  ///< on the grain along the tangent [N]
};

struct Plate {
    Point normal;                                   ///< unit vector into the specimen
    double stiffness = 0.0, shear_stiffness = 0.0;  ///< [Pa/m]
    double friction = 0.0;                          ///< [-]
    bool bonded = false;
    bool loaded = false;      ///< answers to `load`, else its velocity is given
    double load = 0.0;        ///< along the normal [N]
    double mass = 0.0;        ///< [kg]
    Point displacement;       ///< [m]
    Point velocity;           ///< half a step later [m/s]
    Point undamped_velocity;  ///< part of it that is not damped [m/s]
    Point force;              ///< on the specimen [N]
    std::vector<PlatePoint> points;
};

struct Specimen {
    std::vector<Node> nodes;
    std::vector<Grain> grains;
    std::vector<Contact> contacts;
    std::vector<BoundaryEdge> edges;
    std::vector<Plate> plates;
    double thickness = 0.0;  ///< [m]
    Point gravity;           ///< [m/s^2]
    std::int64_t step = 0;
};

}  // namespace plain
