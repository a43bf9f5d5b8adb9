// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Parts that hold and load a specimen: rigid plates against its outline, paper Sec. 4.1,
/// and sets of nodes. All members mean the same in 2D and in 3D. SI units; forces are those on the
/// specimen.
#pragma once

#include <flexpm/kernel/core/vector.hpp>

#include <array>
#include <vector>

namespace flexpm {

/// Point of a plate: where it may touch one facet of the boundary, which is an edge in 2D and a
/// triangle in 3D. All points of a facet follow each other.
struct PlatePoint {
    int facet = 0;
    std::array<double, 3> weights {};  ///< of the facet's nodes, two of an edge [-]
    bool whole = false;                ///< the middle of its facet, which is all its own
    double area = 0.0;                 ///< tributary to it [m^2]
    Vector normal;         ///< into the specimen; of a jaw the point's own, else the plate's
    Vector arm;            ///< of a plate with a seat, see seat_arm() [m]
    double gap = 0.0;      ///< at the reference [m]
    double opening = 0.0;  ///< gap at the last step [m]
    Point shear;           ///< force on the grain along face_axes() [N]
    Vector slip;           ///< sliding along the face, which friction opposes [m]
    double friction_energy = 0.0;  ///< dissipated by that [J]

    /// Calls visit(name, member) for all members.
    template <class Self, class Visitor> static void visit_members(Self& s, Visitor&& visit)
    {
        visit("facet", s.facet);
        visit("weights", s.weights);
        visit("whole", s.whole);
        visit("area", s.area);
        visit("normal_x", s.normal.x);
        visit("normal_y", s.normal.y);
        visit("normal_z", s.normal.z);
        visit("arm_x", s.arm.x);
        visit("arm_y", s.arm.y);
        visit("arm_z", s.arm.z);
        visit("gap", s.gap);
        visit("opening", s.opening);
        visit("shear_x", s.shear.x);
        visit("shear_y", s.shear.y);
        visit("slip_x", s.slip.x);
        visit("slip_y", s.slip.y);
        visit("slip_z", s.slip.z);
        visit("friction_energy", s.friction_energy);
    }
};

/// A straight plate that loads grains through one-point contacts. It does not turn; its normal
/// points into the specimen, and forces are positive along it. Its contacts are the middles of
/// facets of rigid grains and of triangles, or both ends of the edges of deformable grains, each
/// with half of the edge: a boundary node then carries its tributary length. Contacts are elastic
/// and only press, unless the plate is bonded.
///
/// A jaw is a plate whose face is an arc of a circle: each point has a normal of its own, that of
/// the arc at the reference (deviation D95).
///
/// A seated plate turns about the middle of its face as its contacts want it to (deviation D95).
struct Plate {
    // what it is
    int side = -1;                 ///< side of the outline it lies on; -1: none in particular
    Vector position;               ///< of its face at the reference, where its load acts [m]
    Vector normal;                 ///< unit vector
    double face_area = 0.0;        ///< of the face that takes pressure [m^2]
    double width = 0.0;            ///< length of that face if it spans the thickness, else 0 [m]
    double stiffness = 0.0;        ///< normal stiffness per area K_n [Pa/m]
    double shear_stiffness = 0.0;  ///< [Pa/m], of frictional contacts
    double friction = 0.0;         ///< coefficient [-]; 0: smooth
    bool bonded = false;           ///< pulls as well as it presses
    double strip = 0.0;        ///< stiffness per area of a layer on its face, which `stiffness` has
                               ///< in series [Pa/m]; 0: none
    double jaw_radius = 0.0;   ///< of the arc of a jaw [m]; 0: straight
    double disc_radius = 0.0;  ///< of the disc in it [m]
    bool seated = false;       ///< turns freely about its seat

    // what drives it
    bool loaded = false;  ///< moves along its normal under `load`; else `velocity` is prescribed
    double load = 0.0;    ///< force on the plate along its normal [N]
    Vector velocity;      ///< half a step after `displacement` [m/s]
    double mass = 0.0;    ///< of a loaded plate, scaled [kg]
    /// Spring between the plate and its crosshead, which then has `velocity`; it gives way along
    /// the normal (deviation D95) [N/m]. 0: none.
    double machine_stiffness = 0.0;

    // state
    Vector displacement;        ///< [m]
    double machine_give = 0.0;  ///< what that spring is shorter by [m]
    Vector turn;                ///< of a seated one from square to its normal; in 2D about z,
                                ///< counter-clockwise [rad]
    std::vector<PlatePoint> points;
    Vector force;  ///< on the specimen at the last step [N]

    // energy [J]
    double boundary_work = 0.0, boundary_work_next = 0.0;  ///< next: of the half step that follows
    double damping_work = 0.0, damping_work_next = 0.0;
    double drag_work = 0.0, drag_work_next = 0.0;  ///< part of it, see EnergyLedger
    double friction_energy = 0.0;                  ///< of all points
    double kinetic = 0.0;
    double unbalanced = 0.0;  ///< force on a loaded plate that nothing balances [N]

    /// Calls visit(name, member) for all members.
    template <class Self, class Visitor> static void visit_members(Self& s, Visitor&& visit)
    {
        visit("side", s.side);
        visit("position_x", s.position.x);
        visit("position_y", s.position.y);
        visit("position_z", s.position.z);
        visit("normal_x", s.normal.x);
        visit("normal_y", s.normal.y);
        visit("normal_z", s.normal.z);
        visit("face_area", s.face_area);
        visit("width", s.width);
        visit("stiffness", s.stiffness);
        visit("shear_stiffness", s.shear_stiffness);
        visit("friction", s.friction);
        visit("bonded", s.bonded);
        visit("strip", s.strip);
        visit("jaw_radius", s.jaw_radius);
        visit("disc_radius", s.disc_radius);
        visit("seated", s.seated);
        visit("loaded", s.loaded);
        visit("load", s.load);
        visit("velocity_x", s.velocity.x);
        visit("velocity_y", s.velocity.y);
        visit("velocity_z", s.velocity.z);
        visit("mass", s.mass);
        visit("machine_stiffness", s.machine_stiffness);
        visit("displacement_x", s.displacement.x);
        visit("displacement_y", s.displacement.y);
        visit("displacement_z", s.displacement.z);
        visit("machine_give", s.machine_give);
        visit("turn_x", s.turn.x);
        visit("turn_y", s.turn.y);
        visit("turn_z", s.turn.z);
        visit("points", s.points);
        visit("force_x", s.force.x);
        visit("force_y", s.force.y);
        visit("force_z", s.force.z);
        visit("boundary_work", s.boundary_work);
        visit("boundary_work_next", s.boundary_work_next);
        visit("damping_work", s.damping_work);
        visit("damping_work_next", s.damping_work_next);
        visit("drag_work", s.drag_work);
        visit("drag_work_next", s.drag_work_next);
        visit("friction_energy", s.friction_energy);
        visit("kinetic", s.kinetic);
        visit("unbalanced", s.unbalanced);
    }
};

/// Nodes that a test holds or moves as one, wherever they lie: what is held of them has a rigid
/// motion, a translation and a rotation about a pivot. In the plane that is about z,
/// counter-clockwise.
/// Deviation D52: of rigid grains the centres are held, and the grains are free to turn about them.
/// Deviation D53: with `floats` the rotation alone is given; the set moves under the forces on it,
/// so that only a moment acts.
struct NodeSet {
    // what it is
    std::vector<int> nodes;   ///< of deformable grains; of rigid ones their centres
    std::vector<int> grains;  ///< that of each node
    bool holds_x = true, holds_y = true, holds_z = false;
    bool floats = false;

    // what drives it
    Vector velocity;  ///< of the pivot, half a step after `displacement` [m/s]
    Vector spin;      ///< [rad/s]

    // state
    Vector pivot;         ///< where it is now [m]
    Vector displacement;  ///< of the pivot [m]
    Vector angle;         ///< sum of what it has turned by [rad]
    Vector force;         ///< at the last step [N]
    Vector moment;        ///< about the pivot at the last step [N m]

    // energy [J]
    double work = 0.0, work_next = 0.0;  ///< on the specimen; next: of the half step that follows
    double float_work = 0.0, float_work_next = 0.0;  ///< on the translation of one that floats
    double damping_work = 0.0, damping_work_next = 0.0;
    double drag_work = 0.0, drag_work_next = 0.0;  ///< part of it, see EnergyLedger
    double kinetic = 0.0;                          ///< of the translation of one that floats
    double unbalanced = 0.0;  ///< largest force on it that nothing balances [N]

    /// Where the pivot was at the reference [m].
    Vector laid_pivot() const { return pivot - displacement; }

    bool holds(int axis) const { return axis == 0 ? holds_x : axis == 1 ? holds_y : holds_z; }

    /// Calls visit(name, member) for all members.
    template <class Self, class Visitor> static void visit_members(Self& s, Visitor&& visit)
    {
        visit("nodes", s.nodes);
        visit("grains", s.grains);
        visit("holds_x", s.holds_x);
        visit("holds_y", s.holds_y);
        visit("holds_z", s.holds_z);
        visit("floats", s.floats);
        visit("velocity_x", s.velocity.x);
        visit("velocity_y", s.velocity.y);
        visit("velocity_z", s.velocity.z);
        visit("spin_x", s.spin.x);
        visit("spin_y", s.spin.y);
        visit("spin_z", s.spin.z);
        visit("pivot_x", s.pivot.x);
        visit("pivot_y", s.pivot.y);
        visit("pivot_z", s.pivot.z);
        visit("displacement_x", s.displacement.x);
        visit("displacement_y", s.displacement.y);
        visit("displacement_z", s.displacement.z);
        visit("angle_x", s.angle.x);
        visit("angle_y", s.angle.y);
        visit("angle_z", s.angle.z);
        visit("force_x", s.force.x);
        visit("force_y", s.force.y);
        visit("force_z", s.force.z);
        visit("moment_x", s.moment.x);
        visit("moment_y", s.moment.y);
        visit("moment_z", s.moment.z);
        visit("work", s.work);
        visit("work_next", s.work_next);
        visit("float_work", s.float_work);
        visit("float_work_next", s.float_work_next);
        visit("damping_work", s.damping_work);
        visit("damping_work_next", s.damping_work_next);
        visit("drag_work", s.drag_work);
        visit("drag_work_next", s.drag_work_next);
        visit("kinetic", s.kinetic);
        visit("unbalanced", s.unbalanced);
    }
};

/// The edge of a rigid grain that must not move along an axis, see hold_side().
struct HeldEdge {
    int grain = 0;
    int axis = 0;
    double lever =
        0.0;  ///< velocity along the axis that a spin of 1 gives to it, at the reference [m]

    /// Calls visit(name, member) for all members.
    template <class Self, class Visitor> static void visit_members(Self& s, Visitor&& visit)
    {
        visit("grain", s.grain);
        visit("axis", s.axis);
        visit("lever", s.lever);
    }
};

}  // namespace flexpm
