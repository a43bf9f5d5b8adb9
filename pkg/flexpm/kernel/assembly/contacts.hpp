// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The saved state of all contacts: bonds of the specimen and discs that have come to touch.
#pragma once

#include <flexpm/kernel/assembly/layout.hpp>
#include <flexpm/kernel/core/member_rows.hpp>
#include <flexpm/kernel/law/bilinear.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace flexpm {

using GrainPair = std::array<int, 2>;  ///< two grains, the smaller number first

/// How a point of contact lost its bond; one that a script has erased did not crack.
enum CrackMode : std::uint8_t { intact = 0, tensile_crack = 1, shear_crack = 2, erased_point = 3 };

/// When, how and where a point has lost its bond, and what its damage had taken until then.
struct PointCrack {
    int step = -1;  ///< of the crack or the erasure, -1 while intact
    CrackMode mode = intact;
    Point position;       ///< [m]
    double energy = 0.0;  ///< [J]
};

/// Rows of a point: a member of PointState or LawParameters each.
constexpr int point_rows = row_count<PointState>;
constexpr int law_rows = row_count<LawParameters>;

/// Rows of a contact's nodes: ends of the edges of grains a and b, and the places of their centres
/// in StepPlan::next_centre.
struct NodeRow {
    enum : int { a0, a1, b0, b1, centre_a, centre_b, count };
};

/// Contacts with faces of as many corners, which act at as many points: in the plane all of them.
struct ContactGroup {
    int corners = 2;  ///< nodes of each grain's face, which is an edge in the plane
    int points = 3;   ///< 1, 2 or 3

    template <class Self, class Visitor> static void visit_members(Self& s, Visitor&& visit)
    {
        visit("corners", s.corners);
        visit("points", s.points);
    }
};

/// Contacts in the order of their grain pair. Arrays named in the plural are laid out
/// [block][row][lane]; the function in the singular is one value of one contact.
struct Contacts {
    static constexpr int force_values = 4 * dimension;  ///< components on the nodes a0, a1, b0, b1

    int count = 0;
    ContactGroup group;  ///< of all of them; read it by group_in() and group_of()
    std::vector<LawParameters> laws;
    std::vector<GrainPair> pairs;
    std::vector<int> id;     ///< lasting number: a place in the arrays changes, this does not
    int next_id = 0;         ///< of the next contact; none is given twice
    std::vector<int> law;    ///< index into `laws`
    std::vector<int> joint;  ///< joint on which the contact lies, -1: none
    std::vector<std::uint8_t> bonded;  ///< 1: since the specimen was bonded, 0: touched later
    /// 1: a bond that a script has erased; its row is kept, without effect, for the record of
    /// cracks.
    std::vector<std::uint8_t> erased;
    /// Distance of centres of grains that share no edge, though their discs overlap when bonded
    /// [m].
    std::map<GrainPair, double> close_pairs;
    Array<int> nodes;       ///< [NodeRow]
    Array<double> weights;  ///< [point][side]: share of the edge's second node [-]
    Array<double> areas;    ///< [point] [m^2]
    /// [component] from centre a to centre b when bonded [m]; zero: the normal is that of the
    /// edges.
    Array<double> branches;
    Array<double> inverse_edge_lengths;  ///< [side]: 1 / (edge along the tangent) when bonded [1/m]
    Array<double> normals;               ///< [component] of the current unit normal, from a to b
    Array<double> states;                ///< [point][row of PointState]
    /// [point]: slip at which its places on the two edges lay opposite to each other [m]; 0 until
    /// faces slide far.
    Array<double> paired_slips;
    /// [point]: plastic slip since the crack [m]; 0 of a law whose friction stays.
    Array<double> crack_slips;
    Array<int> crack_steps;           ///< [point]: step of the crack or erasure, -1 while intact
    Array<std::uint8_t> crack_modes;  ///< [point]: CrackMode
    Array<double> crack_positions;    ///< [point][component] where it cracked [m]
    Array<double> crack_energies;     ///< [point]: dissipated by damage until it cracked [J]
    /// `force_values` of each contact, one contact after the other, as nodes gather them [N]; a
    /// force of zero follows the last block, see no_force().
    Array<double> forces;

    int blocks() const { return blocks_of(count); }
    const ContactGroup& group_in(int /*block*/) const { return group; }
    const ContactGroup& group_of(int contact) const { return group_in(contact / lanes); }
    int points_in(int block) const { return group_in(block).points; }
    int points_of(int contact) const { return group_of(contact).points; }
    int corners_of(int contact) const { return group_of(contact).corners; }

    const LawParameters& law_of(int contact) const { return laws[law[contact]]; }

    /// Index of a value of a point in an array with `rows` rows for each point.
    int point_index(int contact, int point, int row = 0, int rows = 1) const
    {
        return row_index(contact, point * rows + row, points_of(contact) * rows);
    }

    /// Offset of a node: a corner of the face of a side (0: grain a, 1: grain b).
    int& node(int contact, int side, int corner)
    {
        return nodes[node_index(contact, side, corner)];
    }
    int node(int contact, int side, int corner) const
    {
        return nodes[node_index(contact, side, corner)];
    }

    /// Both nodes of the edge of a side.
    std::array<int, 2> edge(int contact, int side) const
    {
        return { node(contact, side, 0), node(contact, side, 1) };
    }

    double& weight(int contact, int point, int side)
    {
        return weights[point_index(contact, point, side, 2)];
    }
    double weight(int contact, int point, int side) const
    {
        return weights[point_index(contact, point, side, 2)];
    }

    double& area(int contact, int point) { return areas[point_index(contact, point)]; }
    double area(int contact, int point) const { return areas[point_index(contact, point)]; }

    double& inverse_edge_length(int contact, int side)
    {
        return inverse_edge_lengths[row_index(contact, side, 2)];
    }
    double inverse_edge_length(int contact, int side) const
    {
        return inverse_edge_lengths[row_index(contact, side, 2)];
    }

    double& state(int contact, int point, double PointState::*member)
    {
        return states[point_index(contact, point, member_row(member), point_rows)];
    }
    double state(int contact, int point, double PointState::*member) const
    {
        return states[point_index(contact, point, member_row(member), point_rows)];
    }

    PointState point_state(int contact, int point) const
    {
        return load_rows<PointState>(&states[point_index(contact, point, 0, point_rows)], 0);
    }
    void set_point_state(int contact, int point, const PointState& s)
    {
        store_rows(s, &states[point_index(contact, point, 0, point_rows)], 0);
    }

    double& paired_slip(int contact, int point)
    {
        return paired_slips[point_index(contact, point)];
    }
    double paired_slip(int contact, int point) const
    {
        return paired_slips[point_index(contact, point)];
    }

    double& crack_slip(int contact, int point) { return crack_slips[point_index(contact, point)]; }
    double crack_slip(int contact, int point) const
    {
        return crack_slips[point_index(contact, point)];
    }

    Point branch(int contact) const { return vector_at(branches, vector_index(contact)); }
    void set_branch(int contact, Point p) { set_vector(branches, vector_index(contact), p); }
    Point normal(int contact) const { return vector_at(normals, vector_index(contact)); }
    void set_normal(int contact, Point p) { set_vector(normals, vector_index(contact), p); }

    PointCrack crack(int contact, int point) const
    {
        const int index = point_index(contact, point);
        return { crack_steps[index], static_cast<CrackMode>(crack_modes[index]),
            vector_at(crack_positions, point_index(contact, point, 0, dimension)),
            crack_energies[index] };
    }
    void set_crack(int contact, int point, const PointCrack& crack)
    {
        const int index = point_index(contact, point);
        crack_steps[index] = crack.step;
        crack_modes[index] = crack.mode;
        set_vector(crack_positions, point_index(contact, point, 0, dimension), crack.position);
        crack_energies[index] = crack.energy;
    }

    /// Index of the x component of the force on a node, as node() has them; y follows.
    static int force_index(int contact, int side, int corner)
    {
        return contact * force_values + (2 * side + corner) * dimension;
    }
    Point force(int contact, int side, int corner) const
    {
        const double* first = &forces[force_index(contact, side, corner)];
        return { first[0], first[1] };
    }

    /// The same of a force of zero behind all others: it stands for no contact.
    int no_force() const { return blocks() * lanes * force_values; }
    void append_no_force() { forces.resize(static_cast<std::size_t>(no_force()) + dimension, 0.0); }

    /// Calls visit(array, rows, index) for all arrays with rows per contact; index(contact, row,
    /// rows) is the place of a value.
    template <class Self, class Visitor> static void visit_rows(Self& s, Visitor&& visit)
    {
        visit(s.nodes, static_cast<int>(NodeRow::count), row_index);
        const int points = s.group.points;
        visit(s.weights, 2 * points, row_index);
        visit(s.areas, points, row_index);
        visit(s.branches, dimension, row_index);
        visit(s.inverse_edge_lengths, 2, row_index);
        visit(s.normals, dimension, row_index);
        visit(s.states, points * point_rows, row_index);
        visit(s.paired_slips, points, row_index);
        visit(s.crack_slips, points, row_index);
        visit(s.crack_steps, points, row_index);
        visit(s.crack_modes, points, row_index);
        visit(s.crack_positions, points * dimension, row_index);
        visit(s.crack_energies, points, row_index);
        visit(s.forces, force_values, record_index);
    }

    /// Calls visit(name, member) for all members.
    template <class Self, class Visitor> static void visit_members(Self& s, Visitor&& visit)
    {
        visit("count", s.count);
        visit("group", s.group);
        visit("laws", s.laws);
        visit("pairs", s.pairs);
        visit("id", s.id);
        visit("next_id", s.next_id);
        visit("law", s.law);
        visit("joint", s.joint);
        visit("bonded", s.bonded);
        visit("erased", s.erased);
        visit("close_pairs", s.close_pairs);
        visit("nodes", s.nodes);
        visit("weights", s.weights);
        visit("areas", s.areas);
        visit("branches", s.branches);
        visit("inverse_edge_lengths", s.inverse_edge_lengths);
        visit("normals", s.normals);
        visit("states", s.states);
        visit("paired_slips", s.paired_slips);
        visit("crack_slips", s.crack_slips);
        visit("crack_steps", s.crack_steps);
        visit("crack_modes", s.crack_modes);
        visit("crack_positions", s.crack_positions);
        visit("crack_energies", s.crack_energies);
        visit("forces", s.forces);
    }

private:
    int node_index(int contact, int side, int corner) const
    {
        return row_index(contact, corners_of(contact) * side + corner, NodeRow::count);
    }
    static int vector_index(int contact) { return row_index(contact, 0, dimension); }
};

}  // namespace flexpm
