// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The packed state of a bonded assembly of grains, deformable or rigid: everything that moves.
///
/// Grains of one mesh connectivity form a group and are stepped `lanes` at a time, one in each lane.
/// Node arrays are laid out [block][node of the grain][x, y][lane]; a node is named by the offset of
/// its x value, its y value lies `lanes` further. Contacts are laid out [block][row][lane] in the order
/// of their grain pair, their forces one contact after the other. Lanes that no grain or contact fills
/// repeat a real one, without stiffness or area. SI units, tension positive.
#pragma once

#include <flexpm/kernel/assembly/plate.hpp>
#include <flexpm/kernel/core/array.hpp>
#include <flexpm/kernel/core/vector.hpp>
#include <flexpm/kernel/fem/triangle.hpp>
#include <flexpm/kernel/law/bilinear.hpp>

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace flexpm {

/// Connectivity shared by the grains of one group. Nodes: outer vertices first, then the centre.
/// Rigid grains have no triangles: their nodes move as one body about the centre.
struct MeshGroup {
    int vertices = 0;            ///< outer vertices; node number `vertices` is the centre
    int nodes = 0;               ///< all nodes of a grain
    std::vector<int> triangles;  ///< three node numbers each, counter-clockwise
    bool rigid = false;
};

/// How a point of contact cracked.
enum CrackMode : std::uint8_t { intact = 0, tensile_crack = 1, shear_crack = 2 };

/// Rows of a contact block, in units of `lanes`; forces of contacts are values one after the other.
struct ContactRows {
    static constexpr int nodes = 6;  ///< a0, a1, b0, b1, centre a, centre b
    static constexpr int state = 7;  ///< members of PointState, in their order
    static constexpr int opening = 0, slip = 3, shear_damage = 4;  ///< some of them
    static constexpr int forces = 8;  ///< x, y of the forces on a0, a1, b0, b1
    static constexpr int plate = 4;   ///< of a boundary edge: first row of the plates' forces
};

struct Assembly {
    int grains = 0;
    int contacts = 0;
    int edges = 0;           ///< boundary edges
    int points = 3;          ///< contact points per contact: 1, 2 or 3
    double thickness = 0.0;  ///< out of plane [m]
    Point gravity;           ///< acceleration of all masses [m/s^2], by set_gravity()

    // grains
    std::vector<MeshGroup> groups;
    std::vector<int> block_group;      ///< group of each block of grains
    std::vector<int> block_nodes;      ///< offset of the block in the node arrays
    std::vector<int> block_triangles;  ///< offset of the block in `shape`
    std::vector<int> grain_slot;       ///< block * lanes + lane of each grain
    std::vector<int> slot_grain;       ///< grain of each slot, -1 where padded
    std::vector<double> radius;        ///< disc radius of each grain [m]
    std::vector<int> aggregate;        ///< grain of the rock that each is, or is a particle of
    std::vector<int> grain_material;   ///< index into `elastic`
    std::vector<ElasticMaterial> elastic;

    // nodes: [block][node][x, y][lane]
    Array<double> reference;     ///< position when bonded [m]
    Array<double> displacement;  ///< from `reference` [m]
    Array<double> velocity;      ///< half a step after `displacement` [m/s]
    Array<double> force;         ///< contacts, elements, pressure; without damping [N]
    Array<std::uint8_t> held;    ///< 1: the velocity is prescribed, not integrated
    Array<double> inverse_mass;  ///< [block][node][lane], of the scaled or real mass [1/kg]

    // rigid grains, without meaning for others: [block][lane] unless said. Their mass is that of the
    // centre node, which alone can be held; velocities of all nodes follow from centre and spin.
    Array<double> rotation;         ///< [block][cos - 1, sin, angle][lane] from the reference
    Array<double> spin;             ///< angular velocity, half a step after `rotation` [rad/s]
    Array<double> inverse_inertia;  ///< of the scaled or real moment of inertia [1/(kg m^2)]
    Array<std::uint8_t> spin_held;  ///< 1: the spin is prescribed

    /// Displacement of the centres at the end of the step, [block][lane][x, y]; each step fills it.
    Array<double> next_centre;

    // triangles: [block][triangle][g1x, g1y, g2x, g2y, volume][lane]
    Array<double> shape;
    Array<double> stiffness;  ///< [block][normal, cross, shear][lane] [Pa]

    // contacts: [block][row][lane] unless said
    std::vector<LawParameters> laws;
    std::vector<int> contact_grains;  ///< two per contact, the smaller first
    std::vector<int> contact_law;     ///< index into `laws`
    std::vector<std::uint8_t>
        contact_bonded;  ///< 1: since the specimen was bonded, 0: touched later
    /// Distance of centres of grains that share no edge, though their discs overlap when bonded [m].
    std::map<std::pair<int, int>, double> close_pairs;
    Array<int> contact_nodes;  ///< offsets: of nodes, and of grains a and b in `next_centre`
    Array<double> weight;      ///< [point][side]: share of the edge's second node [-]
    Array<double> area;        ///< [point] [m^2]
    /// [x, y] from centre a to centre b when bonded [m]; zero: the normal is that of the edges.
    Array<double> span;
    Array<double> edge_reach;        ///< [side]: 1 / (edge along the tangent) when bonded [1/m]
    Array<double> normal;            ///< [x, y] of the current unit normal, from a to b
    Array<double> point_state;       ///< [point][ContactRows::state]
    Array<int> crack_step;           ///< [point]: step of the crack, -1 while intact
    Array<std::uint8_t> crack_mode;  ///< [point]: CrackMode
    Array<double> crack_position;    ///< [point][x, y] where it cracked [m]
    /// ContactRows::forces [N], one contact after the other, as grains gather them; zeros follow the
    /// last block.
    Array<double> contact_force;

    // boundary edges: [block][row][lane]
    std::vector<int> edge_grain;
    std::vector<int> edge_side;         ///< side of the outline
    std::vector<double> edge_pressure;  ///< follows the deforming edge, compressive positive [Pa]
    Array<int> edge_nodes;              ///< [n0, n1] node offsets, counter-clockwise in the grain
    Array<double> edge_force;           ///< x, y on n0, n1: of pressure, then of plates [N]

    std::vector<Plate> plates;

    // not saved: which forces act on a grain, per block: force offset, local offset of first and second node
    std::vector<int> gather_first;
    std::vector<int> gather;

    // the same sorted by nodes, not saved: offset of the first and of the second contact force, or of the
    // zeros behind all, [block][node][first, second][lane], then [source, local offset of the node] per
    // block
    std::vector<int> source_pairs;
    std::vector<int> more_first;
    std::vector<int> more_sources;

    /// Not saved: 1 where all contacts of a block lie between whole edges that both grains share, with
    /// points at the ends and in the middle: weights 0, 1/2, 1 and one reach for both, equal end areas.
    std::vector<std::uint8_t> whole_edges;

    // the order of a step, not saved: which blocks of grains have their last contact in each chunk of
    // contact blocks, and the chunk of the first contact of each block of grains
    std::vector<int> chunk_first;   ///< offset of each chunk in `chunk_blocks`
    std::vector<int> chunk_blocks;  ///< blocks of grains
    std::vector<int> first_chunk;

    // what contacts ask for ahead, not saved, empty where the caches hold all: for each block of contacts
    // the lines of x values of nodes in `velocity`, and as ~line of centres in `next_centre`, that none of
    // the blocks just before it reads
    std::vector<int> fetch_first;
    std::vector<int> fetch_lines;

    /// Current positions [m]; empty until a script asks for them, then kept up to date by each step.
    Array<double> shown_position;

    /// Not saved: what elements add to StiffnessBound::node [N/m]; empty until prepare_step() finds
    /// it, and again once a grain is taken out.
    Array<double> element_bound;

    // sums that only grow; energies in J. Per block of grains unless said.
    Array<double> damping_work;  ///< [block][done, second half of the last step]
    Array<double> driven_work;   ///< the same for nodes with prescribed velocity
    double pressure_work = 0.0;
    double past_damage = 0.0;  ///< dissipated by contacts that are gone
    double past_friction = 0.0;
    double initial_energy = 0.0;  ///< kinetic and elastic energy when the books were opened
    std::int64_t step = 0;        ///< steps done

    // results of the last measured step, per block
    Array<double> kinetic;        ///< 1/2 m v(n-1/2) v(n+1/2) [J]
    Array<double> largest_force;  ///< largest |F| component on a free node [N]

    int blocks() const { return static_cast<int>(block_group.size()); }
    int contact_blocks() const { return (contacts + lanes - 1) / lanes; }
    int chunks() const { return static_cast<int>(chunk_first.size()) - 1; }
    int edge_blocks() const { return (edges + lanes - 1) / lanes; }
    const MeshGroup& group(int block) const { return groups[block_group[block]]; }
    bool is_rigid(int grain) const { return group(grain_slot[grain] / lanes).rigid; }
    int nodes_of(int grain) const { return group(grain_slot[grain] / lanes).nodes; }

    /// Offset of a grain's node in the node arrays (its x value).
    int node(int grain, int number) const
    {
        const int slot = grain_slot[grain];
        return block_nodes[slot / lanes] + 2 * lanes * number + slot % lanes;
    }
    int centre(int grain) const { return node(grain, group(grain_slot[grain] / lanes).vertices); }

    /// Offset of a grain's centre in `next_centre`.
    int centre_slot(int grain) const { return 2 * grain_slot[grain]; }

    Point position(int node) const
    {
        return { reference[node] + displacement[node],
            reference[node + lanes] + displacement[node + lanes] };
    }
};

/// Index into the arrays with one value per node, from a node's offset.
inline int scalar_index(int node) { return (node + node % lanes) / 2; }

/// Index of a value of a contact (or boundary edge) in an array with `rows` rows per block.
inline int row_index(int contact, int row, int rows)
{
    return (contact / lanes * rows + row) * lanes + contact % lanes;
}

/// The same in an array in which the values of one contact follow those of the other.
inline int record_index(int contact, int value, int values) { return contact * values + value; }

/// Calls visit(name, member) for all that must be saved to continue a run to the same bits.
template <class AssemblyType, class Visitor> void visit_state(AssemblyType& a, Visitor&& visit);

}  // namespace flexpm

#include <flexpm/kernel/assembly/serialization.hpp>
