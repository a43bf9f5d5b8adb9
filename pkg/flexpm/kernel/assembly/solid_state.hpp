// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The state of a bonded specimen in space, polyhedral grains that deform or are rigid, and
/// apart from it the plan of a step. SI units, tension positive.
///
/// Grains are laid out by `space_layout`: a block holds one grain, in lane 0 of its slots, whose
/// nodes follow each other, [node][x y z 0], and fill an even number of rows. A lane is a
/// tetrahedron of one grain, or a contact among those whose faces have as many corners.
#pragma once

#include <flexpm/kernel/assembly/bonded_state.hpp>
#include <flexpm/kernel/assembly/contacts.hpp>
#include <flexpm/kernel/assembly/pair_contacts.hpp>
#include <flexpm/kernel/assembly/pair_plan.hpp>
#include <flexpm/kernel/core/quaternion.hpp>
#include <flexpm/kernel/core/space_vector.hpp>
#include <flexpm/kernel/law/face_point.hpp>
#include <flexpm/kernel/law/solid_elastic.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace flexpm {

/// Tetrahedra of the grains in batches of `lanes`, each of one grain. Corner 0 of all is the
/// grain's centre. Lanes that nothing fills repeat a real one without volume.
struct Tetrahedra {
    /// Rows of TetrahedronShape: gradients of corners 1 to 3, and the volume.
    enum : int { gradients = 0, volume = 9, rows = 10 };
    static constexpr int corners = 3;

    std::vector<int> first;  ///< batch of each block of grains, and the end
    Array<int> nodes;        ///< [batch][corner][lane], from the grain's first node
    Array<double> shape;     ///< [batch][row][lane]

    int batches() const { return first.empty() ? 0 : first.back(); }

    template <class Self, class Visitor> static void visit_members(Self& s, Visitor&& visit)
    {
        visit("first", s.first);
        visit("nodes", s.nodes);
        visit("shape", s.shape);
    }
};

/// Rows of a point of a face that is or was beyond its elastic branch, or shares a block with one:
/// its slip at the last forces, its FacePointState, and its slip since the crack. A point without
/// damage reads and writes the first ones alone.
struct FaceRow {
    enum : int {
        slip_x,
        slip_y,
        max_opening,
        shear_damage,
        plastic_x,
        plastic_y,
        damage_energy,
        friction_energy,
        crack_slip,  ///< plastic slip since the crack [m]; 0 of a law whose friction stays
        count
    };
};

/// Most corners of a face between two grains.
constexpr int most_corners = 24;

/// Contacts whose faces have as many corners and points.
struct FaceGroup {
    int corners = 0;  ///< of the polygon
    int points = 0;
    int at_corners = 0;  ///< the first of the points are the corners: 0 or `corners`

    bool operator<(const FaceGroup& o) const
    {
        return std::array<int, 3> { corners, points, at_corners }
        < std::array<int, 3> { o.corners, o.points, o.at_corners };
    }

    template <class Self, class Visitor> static void visit_members(Self& s, Visitor&& visit)
    {
        visit("corners", s.corners);
        visit("points", s.points);
        visit("at_corners", s.at_corners);
    }
};

/// When, how and where a point of a face has lost its bond, and what its damage had taken by then.
struct FaceCrack {
    std::int64_t step = -1;  ///< -1 while intact
    CrackMode mode = intact;
    Vector position;      ///< [m]
    double energy = 0.0;  ///< [J]

    template <class Self, class Visitor> static void visit_members(Self& s, Visitor&& visit)
    {
        visit("step", s.step);
        visit("mode", s.mode);
        visit("position_x", s.position.x);
        visit("position_y", s.position.y);
        visit("position_z", s.position.z);
        visit("energy", s.energy);
    }
};

/// Blocks of grains whose contacts follow each other: what a step reads and writes of them stays in
/// a cache.
constexpr int tile_grains = 128;

/// Contacts in the order of their grain pair; a block holds `lanes` of one group and of one tile,
/// that of the first of their two blocks of grains, and either all or none of them reach grains of
/// another tile. So a tile's grains have their last contact in it. A normal points from the first
/// grain to the second, and corners are counter-clockwise as seen from its tip. The first tangent
/// follows a line from corner 0.
struct FaceContacts {
    int count = 0;
    std::vector<LawParameters> laws;
    std::vector<GrainPair> pairs;
    std::vector<int> law;    ///< index into `laws`
    std::vector<int> joint;  ///< of each contact, -1: none; empty of a solid without joints
    std::vector<int> slot;   ///< block * lanes + lane of each contact
    std::vector<FaceGroup> groups;
    std::vector<int> block_group;   ///< group of each block
    std::vector<int> block_nodes;   ///< offset of each block in `nodes`, and the end
    std::vector<int> block_points;  ///< offset of each block in `areas`, and the end
    std::vector<int> block_shares;  ///< offset of each block in `shares`, and the end
    std::vector<int> in_slot;       ///< contact in each slot, -1 where padded
    Array<int> nodes;               ///< [block][corner][side][lane]: offset of the node
    Array<int> line;                ///< [block][lane]: corner at the end of the line
    Array<double> places;           ///< [block][corner][component][lane] when bonded [m]
    Array<double> areas;  ///< that act, [block][point][lane] [m^2]; 0 where padded or ended
    /// Areas when bonded, laid out as `areas`; empty as long as no contact has ended.
    Array<double> bonded_areas;
    /// 1: the faces lie on each other no more, and a pair has taken over; empty as long as there is
    /// none.
    std::vector<std::uint8_t> ended;
    Array<double> shares;  ///< [block][point that is no corner][corner][lane], with sum 1 [-]
    /// [block][point][FaceRow][lane]; empty of a block whose points have never left their elastic
    /// branch: what they bear follows from the places of their nodes alone.
    std::vector<Array<double>> states;
    /// [block][point][lane]; empty of a block without any, which most are.
    std::vector<std::vector<FaceCrack>> cracks;

    int blocks() const { return static_cast<int>(block_group.size()); }
    int block_of(int contact) const { return slot[contact] / lanes; }
    int lane_of(int contact) const { return slot[contact] % lanes; }
    const FaceGroup& group_in(int block) const { return groups[block_group[block]]; }
    const FaceGroup& group_of(int contact) const { return group_in(block_of(contact)); }
    int points_of(int contact) const { return group_of(contact).points; }
    int corners_of(int contact) const { return group_of(contact).corners; }
    const LawParameters& law_of(int contact) const { return laws[law[contact]]; }

    /// Index of a corner's node on a side in `nodes`.
    int node_index(int contact, int side, int corner) const
    {
        return block_nodes[block_of(contact)] + (2 * corner + side) * lanes + lane_of(contact);
    }
    int node(int contact, int side, int corner) const
    {
        return nodes[node_index(contact, side, corner)];
    }

    /// Index of a point in `areas`.
    int point_index(int contact, int point) const
    {
        return block_points[block_of(contact)] + point * lanes + lane_of(contact);
    }
    /// When bonded [m^2].
    double area(int contact, int point) const
    {
        return (bonded_areas.empty() ? areas : bonded_areas)[point_index(contact, point)];
    }
    bool has_ended(int contact) const { return !ended.empty() && ended[contact] != 0; }

    /// Share of a corner in a point.
    double share(int contact, int point, int corner) const
    {
        const FaceGroup& g = group_of(contact);
        if (point < g.at_corners) return point == corner ? 1.0 : 0.0;
        const int row = (point - g.at_corners) * g.corners + corner;
        return shares[block_shares[block_of(contact)] + row * lanes + lane_of(contact)];
    }

    /// A value of a point, by its FaceRow.
    double state(int contact, int point, int row) const
    {
        const Array<double>& own = states[block_of(contact)];
        return own.empty() ? 0.0 : own[state_index(contact, point, row)];
    }
    void set_state(int contact, int point, int row, double value)
    {
        Array<double>& own = states[block_of(contact)];
        if (own.empty()) own.resize(state_count(block_of(contact)), 0.0);
        own[state_index(contact, point, row)] = value;
    }
    /// Index of a value in the states of its block, and number of them.
    int state_index(int contact, int point, int row) const
    {
        return (point * FaceRow::count + row) * lanes + lane_of(contact);
    }
    int state_count(int block) const { return group_in(block).points * FaceRow::count * lanes; }

    FacePointState point_state(int contact, int point) const
    {
        return { state(contact, point, FaceRow::max_opening),
            { state(contact, point, FaceRow::plastic_x),
                state(contact, point, FaceRow::plastic_y) },
            state(contact, point, FaceRow::shear_damage),
            state(contact, point, FaceRow::damage_energy),
            state(contact, point, FaceRow::friction_energy) };
    }
    const FaceCrack& crack(int contact, int point) const
    {
        static const FaceCrack none;
        const auto& own = cracks[block_of(contact)];
        return own.empty() ? none : own[point * lanes + lane_of(contact)];
    }
    void set_crack(int contact, int point, const FaceCrack& crack)
    {
        auto& own = cracks[block_of(contact)];
        if (own.empty()) own.resize(points_of(contact) * lanes);
        own[point * lanes + lane_of(contact)] = crack;
    }

    template <class Self, class Visitor> static void visit_members(Self& s, Visitor&& visit)
    {
        visit("count", s.count);
        visit("laws", s.laws);
        visit("pairs", s.pairs);
        visit("law", s.law);
        visit("joint", s.joint);
        visit("slot", s.slot);
        visit("groups", s.groups);
        visit("block_group", s.block_group);
        visit("block_nodes", s.block_nodes);
        visit("block_points", s.block_points);
        visit("block_shares", s.block_shares);
        visit("in_slot", s.in_slot);
        visit("nodes", s.nodes);
        visit("line", s.line);
        visit("places", s.places);
        visit("areas", s.areas);
        visit("bonded_areas", s.bonded_areas);
        visit("ended", s.ended);
        visit("shares", s.shares);
        visit("states", s.states);
        visit("cracks", s.cracks);
    }
};

/// Triangles of the specimen's surface. What pressures have is empty where none has ever acted.
struct SurfaceTriangles {
    std::vector<int> grain;
    std::vector<int> side;                  ///< SolidSide of the wall
    std::vector<std::array<int, 3>> nodes;  ///< counter-clockwise as seen from outside
    std::vector<double> pressure;           ///< compressive positive [Pa]
    Array<double> push;  ///< force of the pressure at the last forces, [triangle][x y z] [N]
    Array<double> way;   ///< mean displacement there, [triangle][x y z] [m]

    template <class Self, class Visitor> static void visit_members(Self& s, Visitor&& visit)
    {
        visit("grain", s.grain);
        visit("side", s.side);
        visit("nodes", s.nodes);
        visit("pressure", s.pressure);
        visit("push", s.push);
        visit("way", s.way);
    }
};

/// Motion of a rigid grain about its centre, whose node has the mass.
struct RigidBody {
    Quaternion turn;          ///< since the reference
    Vector spin;              ///< half a step later [rad/s]
    Vector angular_momentum;  ///< half a step later [N m s]
    SpaceTensor inertia {};   ///< in the axes of the reference, scaled or real [kg m^2]
    bool spin_held = false;   ///< the spin is given
    Vector moment;            ///< of all forces about the centre, at the last forces [N m]

    template <class Self, class Visitor> static void visit_members(Self& s, Visitor&& visit)
    {
        visit("turn_w", s.turn.w);
        visit("turn_v_x", s.turn.v.x);
        visit("turn_v_y", s.turn.v.y);
        visit("turn_v_z", s.turn.v.z);
        visit("spin_x", s.spin.x);
        visit("spin_y", s.spin.y);
        visit("spin_z", s.spin.z);
        visit("angular_momentum_x", s.angular_momentum.x);
        visit("angular_momentum_y", s.angular_momentum.y);
        visit("angular_momentum_z", s.angular_momentum.z);
        visit("inertia_xx", s.inertia.xx);
        visit("inertia_yy", s.inertia.yy);
        visit("inertia_zz", s.inertia.zz);
        visit("inertia_yz", s.inertia.yz);
        visit("inertia_xz", s.inertia.xz);
        visit("inertia_xy", s.inertia.xy);
        visit("spin_held", s.spin_held);
        visit("moment_x", s.moment.x);
        visit("moment_y", s.moment.y);
        visit("moment_z", s.moment.z);
    }
};

/// Faces of a rigid grain on a side that must not move along an axis, see hold_side().
struct HeldFace {
    int grain = 0;
    int axis = 0;
    Vector arm;  ///< from the centre to the middle of the faces, at the reference [m]

    template <class Self, class Visitor> static void visit_members(Self& s, Visitor&& visit)
    {
        visit("grain", s.grain);
        visit("axis", s.axis);
        visit("arm_x", s.arm.x);
        visit("arm_y", s.arm.y);
        visit("arm_z", s.arm.z);
    }
};

/// Contact of a plate.
struct PlateTouch {
    int plate;
    int index;  ///< of its facets
};

/// Force on a node, or wrench on a rigid grain, that waits until its grain is summed.
struct Parcel {
    int node;   ///< offset from the first node of its block; 0 of a rigid grain
    int place;  ///< index of the x component in SolidPlan::parcels
};

/// Motion of a rigid grain since the reference, as its contacts read it: [x y z 0] of the way of its
/// centre [m], and of what its turn adds to vectors along each axis.
struct RigidMotionRow {
    enum : int { way = 0, of_x = 4, of_y = 8, of_z = 12, count = 16 };
};

/// Forces on a rigid grain: [x y z 0] of their sum [N] and of their moment about its centre [N m].
struct WrenchRow {
    enum : int { force = 0, moment = 4, count = 8 };
};

/// Rows of lanes of a block of contacts between rigid grains at the reference, vectors in three.
/// Places are from the middle of a face, by the areas of its points [m].
struct RigidFaceRow {
    enum : int {
        arm_a = 0,    ///< from the centre of the first grain to the middle [m]
        arm_b = 3,    ///< from that of the second
        area = 6,     ///< twice the area vector [m^2]
        sum = 9,      ///< of the areas of the points; 0 where padded [m^2]
        second = 10,  ///< of areas times xx, yy, zz, yz, xz, xy of places [m^4]
        radius = 16,  ///< largest distance of a point
        count = 17
    };
};

/// Rows of the same blocks that only points beyond the elastic branch need: vectors in three. Steps
/// of intact contacts read fewer lines without them.
struct RigidPlaceRow {
    enum : int {
        line = 0,    ///< from corner 0 to the end of the line [m]
        points = 3,  ///< places of the points [m]
    };
    static int count(int points_of) { return points + 3 * points_of; }
};

/// Where the values of a rigid grain are.
struct BodyPlace {
    int grain;
    int centre;  ///< offset of its node
};

/// What a step derives from the state.
struct SolidPlan {
    // tiles
    std::vector<int> tile_contacts;  ///< first block of contacts of each tile, and the end
    std::vector<int> first_tile;     ///< of each block of grains: tile of its first contact
    std::vector<int> tile_moves;     ///< first of each tile in `moves`, and the end
    std::vector<int> moves;          ///< blocks of grains in the order of their first tile

    // Forces of contacts. Those between grains of one tile are added to the nodes at once, others
    // are parcels, since their grains may be another thread's.
    std::vector<int> first_parcel;  ///< of each block of contacts in `parcels`; -1: it has none
    std::vector<int> block_sums;    ///< first of each block of grains in `sums`, and the end
    std::vector<Parcel> sums;       ///< in the order of blocks of contacts
    /// [block][corner][side][lane][x y z 0] [N], or of rigid grains [block][side][lane][WrenchRow]
    Array<double> parcels;

    // Rigid grains: contacts read their motions and add to their wrenches, so that a step leaves
    // their nodes behind, see show_places() and show_nodes(). Nodes on which plates or pressures act
    // go on with them.
    bool places_behind = false;  ///< places of nodes are those of an earlier step
    bool forces_behind = false;  ///< shown_forces are
    /// On nodes, with those of contacts, of which Grains::force of rigid grains has none [N].
    Array<double> shown_forces;
    std::vector<std::uint8_t> node_loads;  ///< 1 of blocks of grains on whose nodes something acts
    std::vector<BodyPlace> body_places;    ///< of each block of grains
    Array<double> motions;                 ///< [block of grains][RigidMotionRow]
    Array<double> wrenches;                ///< [block of grains][WrenchRow]
    Array<double> faces;                   ///< [block of contacts][RigidFaceRow][lane]
    Array<double> face_places;             ///< [block of contacts][RigidPlaceRow][lane]
    Array<int> face_grains;                ///< [block of contacts][side][lane]: block of the grain

    // contacts of plates on each block of grains, in the order of plates
    std::vector<int> first_press;  ///< of each block, in `presses`, and the end; empty: no plates
    std::vector<PlateTouch> presses;

    // surface triangles of each block of grains, in their order
    std::vector<int> first_pressed;      ///< of each block, in `pressed`; empty: no pressures
    std::vector<int> pressed;            ///< number of the triangle
    std::vector<double> pressure_works;  ///< of each triangle since the last forces [J]

    PairPlan pairs;

    int tiles() const { return static_cast<int>(tile_contacts.size()) - 1; }

    /// Rows of a block of contacts in `faces`.
    static std::size_t first_face(int block)
    {
        return static_cast<std::size_t>(block) * RigidFaceRow::count * lanes;
    }
    /// The same in `face_places`; the end follows the last block.
    static std::size_t first_place(const FaceContacts& c, int block)
    {
        return static_cast<std::size_t>(block) * RigidPlaceRow::points * lanes
            + static_cast<std::size_t>(3) * c.block_points[block];
    }
};

/// Motions of BondedState have the spin as [grain][x y z] and the angle as the turn, [grain][w x y
/// z]. The facets of plates are surface triangles.
struct SolidState : BondedState {
    Tetrahedra tetrahedra;          ///< of rigid grains for their masses alone
    std::vector<RigidBody> bodies;  ///< of each grain; empty: all deform
    FaceContacts contacts;
    std::vector<PairContact> pairs;  ///< of near grains without a common face, ascending
    /// Way that a grain may have moved since pairs were searched; negative: no grain can meet
    /// another [m].
    double unsearched_way = -1.0;
    SurfaceTriangles surface;
    std::vector<HeldFace> held_faces;
    SolidPlan plan;  ///< derived, never saved

    /// Grain of each surface triangle, and the pressures on them [Pa]; empty: there was never one.
    const std::vector<int>& facet_grains() const { return surface.grain; }
    const std::vector<double>& pressures() const { return surface.pressure; }

    /// Whether its grains are rigid; else all deform.
    bool is_rigid() const { return !bodies.empty(); }

    /// Whether the spin of a rigid grain is given.
    bool is_spin_held(int grain) const { return !bodies.empty() && bodies[grain].spin_held; }

    template <class Self, class Visitor> static void visit_members(Self& s, Visitor&& visit)
    {
        BondedState::visit_members(s, visit);
        visit("tetrahedra", s.tetrahedra);
        visit("bodies", s.bodies);
        visit("contacts", s.contacts);
        visit("near_pairs", s.pairs);
        visit("unsearched_way", s.unsearched_way);
        visit("surface", s.surface);
        visit("held_faces", s.held_faces);
    }
};

/// Vector of a node of space.
inline Vector space_vector(const Array<double>& values, int node)
{
    return { values[node], values[node + 1], values[node + 2] };
}
inline void set_space_vector(Array<double>& values, int node, Vector v)
{
    values[node] = v.x;
    values[node + 1] = v.y;
    values[node + 2] = v.z;
}

/// Spin of a rigid grain in a motion.
inline Vector spin_in(const GrainMotion& motion, int grain)
{
    return space_vector(motion.spin, 3 * grain);
}

/// Call visit(grain, number) for each node of all grains.
template <class Visit> void for_each_node(const SolidState& s, Visit visit)
{
    for (int g = 0; g < s.grains.count; ++g)
        for (int n = 0; n < s.grains.nodes_of(g); ++n)
            visit(g, n);
}

}  // namespace flexpm
