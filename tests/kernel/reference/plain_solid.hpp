// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  A solid specimen as a textbook would write it down, and its plain step: what lanes and
/// blocks of solids will have to agree with. Nothing is fast here. SI units, tension and opening
/// positive.
#pragma once

#include <flexpm/kernel/core/quaternion.hpp>
#include <flexpm/kernel/fem/tetrahedron.hpp>
#include <flexpm/kernel/law/face_point.hpp>
#include <flexpm/kernel/space/face_points.hpp>
#include <flexpm/kernel/space/polyhedra.hpp>

#include <array>
#include <vector>

namespace plain_solid {

using flexpm::Point;
using flexpm::Vector;

struct Node {
    Vector reference;             ///< place when bonded [m]
    Vector displacement;          ///< since then [m]
    Vector velocity;              ///< half a step after the displacement [m/s]
    Vector force;                 ///< of the last step, without damping [N]
    std::array<bool, 3> held {};  ///< the velocity along an axis is given
    bool rides = false;           ///< follows a rigid grain, whose centre it is not
    double mass = 0.0;            ///< [kg]

    Vector place() const { return reference + displacement; }
};

struct Grain {
    std::vector<int> nodes;                    ///< the centre is the last
    std::vector<std::array<int, 4>> elements;  ///< nodes, right-handed; none: the grain is rigid
    double radius = 0.0;                       ///< of the sphere of its volume [m]

    // rigid grains
    flexpm::Quaternion turn;         ///< since the reference
    Vector spin;                     ///< half a step later [rad/s]
    Vector angular_momentum;         ///< half a step later [N m s]
    Vector moment;                   ///< of the last step, without damping [N m]
    flexpm::SpaceTensor inertia {};  ///< in the axes of the reference [kg m^2]
    bool spin_held = false;          ///< the spin is given

    bool is_rigid() const { return elements.empty(); }
    int centre() const { return nodes.back(); }
};

struct ContactPoint {
    double area = 0.0;           ///< [m^2]
    std::vector<double> shares;  ///< of the corners [-]
    flexpm::FacePlace at;        ///< opening and slip at the last forces [m]
    flexpm::FacePointState state;
    flexpm::FaceTraction traction {};  ///< of the last forces [Pa]
};

struct Contact {
    std::array<int, 2> grains;
    std::array<std::vector<int>, 2> corners;  ///< nodes of both sides, counter-clockwise from b
    std::array<int, 2> line;                  ///< corners that the first tangent follows
    flexpm::LawParameters law;
    std::vector<ContactPoint> points;
};

/// What has been done and lost from the start to the present places [J]. The forces there work on
/// through half of the coming step, too (`next`).
struct Works {
    double damping = 0.0, damping_next = 0.0;    ///< taken by local damping
    double boundary = 0.0, boundary_next = 0.0;  ///< done by what moves held nodes and spins
};

struct Specimen {
    std::vector<Node> nodes;
    std::vector<Grain> grains;
    std::vector<Contact> contacts;
    flexpm::PlaneStiffness elastic;  ///< of all grains
    double density = 0.0;            ///< [kg/m^3]
    Works works;
};

/// Energies of the state [J]. The kinetic one is that between two half steps.
struct Energies {
    double kinetic = 0.0, strain = 0.0, contact = 0.0, damage = 0.0, friction = 0.0;

    double sum() const { return kinetic + strain + contact + damage + friction; }
};

/// What becomes of cells.
struct Making {
    bool rigid = false;
    bool joined = false;  ///< grains share their nodes and have no contacts
    flexpm::FacePointRule rule = flexpm::FacePointRule::corners_and_inner;
};

/// Specimen of cells at rest, without masses.
Specimen make_specimen(const flexpm::Polyhedra& cells, const flexpm::ElasticMaterial& grain,
    const flexpm::ContactMaterial& contact, const Making& making);

/// Masses with which a step of `dt` is stable with damping alpha: m = 1.1 (1 + alpha) K_t dt^2 / 4
/// from the sum of the norms of the blocks in the row of a node, of elements and points.
void scale_masses(Specimen& specimen, double dt, double damping);

/// Masses and inertias of the cells: a quarter of each tetrahedron to each of its nodes.
void give_real_masses(Specimen& specimen);

/// Nodes of rigid grains follow the centre and the turn.
void follow(Specimen& specimen);

/// Forces at the present places, and the state of the contact points there.
void find_forces(Specimen& specimen);

/// Move, find all forces at the new places, and integrate the velocities, with damping alpha of
/// Eq. 2. Works count.
/// @return  energies of the state, the kinetic one from both half steps
Energies step(Specimen& specimen, double dt, double damping);

}  // namespace plain_solid
