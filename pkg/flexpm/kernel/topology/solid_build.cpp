// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Grains, tetrahedra, contacts and surface of a specimen in space.
#include <flexpm/kernel/topology/solid_build.hpp>

#include <flexpm/kernel/assembly/solid_plan.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/fem/tetrahedron.hpp>
#include <flexpm/kernel/space/face_frame.hpp>
#include <flexpm/kernel/space/face_triangles.hpp>
#include <flexpm/kernel/space/fan_meshes.hpp>
#include <flexpm/kernel/step/solid_masses.hpp>
#include <flexpm/kernel/topology/unbonded.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>

namespace flexpm {

namespace {

constexpr int node_values = space_layout.node_stride;

/// Order of places along a curve that stays near where it has been (Morton order).
class CurveOrder {
public:
    explicit CurveOrder(const Solid& solid) : low_(solid.low)
    {
        const Vector size = solid.high - solid.low;
        scale_ = ((1 << bits) - 1) / std::max({ size.x, size.y, size.z });
    }

    std::uint64_t number(Vector p) const
    {
        const Vector from = scale_ * (p - low_);
        return spread(from.x) | spread(from.y) << 1 | spread(from.z) << 2;
    }

private:
    static constexpr int bits = 16;
    Vector low_;
    double scale_;

    /// Bits of a coordinate, two places apart.
    static std::uint64_t spread(double coordinate)
    {
        const auto cell = static_cast<std::uint64_t>(std::max(coordinate, 0.0));
        std::uint64_t result = 0;
        for (int b = 0; b < bits; ++b)
            result |= (cell >> b & 1) << 3 * b;
        return result;
    }
};

/// Numbers from 0 in the order of their keys, equal ones as they are.
std::vector<int> sorted_by(const std::vector<std::uint64_t>& keys)
{
    std::vector<int> order(keys.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int i, int k) { return keys[i] < keys[k]; });
    return order;
}

/// What is being built, and from what.
struct Building {
    const Polyhedra& cells;
    const Solid& solid;
    const SolidInput& input;
    FanMeshes meshes;
    SolidState state;

    /// Offset of the node of a grain at a vertex of the cells.
    int node(int grain, int vertex) const
    {
        const auto first = meshes.node_vertices.begin() + meshes.node_offsets[grain];
        const auto last = meshes.node_vertices.begin() + meshes.node_offsets[grain + 1] - 1;
        const auto found = std::lower_bound(first, last, vertex);
        return state.grains.node(grain, static_cast<int>(found - first));
    }
};

void check_input(const Polyhedra& cells, const SolidInput& input)
{
    const auto kinds = input.grains.size();
    check_positive("make_solid: kinds of grains", static_cast<double>(kinds), "");
    if (input.contacts.size() != kinds * kinds) {
        refuse("make_solid: kinds of contacts", static_cast<double>(input.contacts.size()), "",
            "must be " + std::to_string(kinds * kinds) + ", one for each pair of kinds of grains");
    }
    if (!input.kind.empty() && static_cast<int>(input.kind.size()) != cells.cells()) {
        refuse("make_solid: kinds given", static_cast<double>(input.kind.size()), "",
            "must be those of " + std::to_string(cells.cells()) + " cells");
    }
    for (int kind : input.kind) {
        if (kind < 0 || kind >= static_cast<int>(kinds)) {
            refuse("make_solid: kind of a cell", static_cast<double>(kind), "",
                "must be below " + std::to_string(kinds));
        }
    }
    if (!input.strength.empty() && static_cast<int>(input.strength.size()) != cells.contacts) {
        refuse("make_solid: factors of strengths", static_cast<double>(input.strength.size()), "",
            "must be those of " + std::to_string(cells.contacts) + " contacts");
    }
    if (!input.joint.empty() && static_cast<int>(input.joint.size()) != cells.contacts) {
        refuse("make_solid: joints given", static_cast<double>(input.joint.size()), "",
            "must be those of " + std::to_string(cells.contacts) + " contacts");
    }
    for (int joint : input.joint) {
        if (joint < -1 || joint >= static_cast<int>(input.joints.size()))
            refuse(
                "make_solid: joint of a contact", joint, "", "must be the index of a joint, or -1");
    }
}

void size_grains(Grains& grains, int values)
{
    const auto blocks = static_cast<std::size_t>(grains.blocks());
    for (auto* rows :
        { &grains.reference, &grains.displacement, &grains.velocity, &grains.force }) {
        rows->assign(values, 0.0);
    }
    grains.prescribed.assign(values, 0);
    grains.inverse_mass.assign(values / node_values, 0.0);
    grains.spin.assign(blocks * lanes, 0.0);
    grains.inverse_inertia.assign(blocks * lanes, 0.0);
    grains.spin_prescribed.assign(blocks * lanes, 0);
    grains.rotation.assign(blocks * lanes * RotationRow::count, 0.0);
    grains.stiffness.assign(blocks * lanes * row_count<PlaneStiffness>, 0.0);
}

/// Blocks along the curve, their nodes, and what grains have each.
void add_grains(Building& b)
{
    Grains& grains = b.state.grains;
    const Polyhedra& cells = b.cells;
    grains.layout = space_layout;
    grains.count = cells.cells();
    grains.elastic = b.input.grains;
    const CurveOrder curve(b.solid);
    std::vector<std::uint64_t> keys;
    for (const Vector& centre : cells.centres)
        keys.push_back(curve.number(centre));
    grains.slot.resize(grains.count);
    int values = 0;
    for (const int g : sorted_by(keys)) {
        const int nodes = static_cast<int>(b.meshes.node_offsets[g + 1] - b.meshes.node_offsets[g]);
        const int block = grains.blocks();
        grains.slot[g] = block * lanes;
        grains.in_slot.resize(grains.in_slot.size() + lanes, -1);
        grains.in_slot[grains.slot[g]] = g;
        grains.groups.push_back({ nodes - 1, nodes, {}, b.input.rigid });
        grains.block_group.push_back(block);
        grains.block_nodes.push_back(values);
        grains.block_triangles.push_back(0);
        values += (nodes + 1) / 2 * 2 * node_values;
    }
    size_grains(grains, values);
    grains.erased.assign(grains.count, 0);
    grains.loose.assign(grains.count, 0);
    grains.material = b.input.kind;
    grains.material.resize(grains.count, 0);
    for (int g = 0; g < grains.count; ++g) {
        grains.parent.push_back(g);
        grains.radius.push_back(std::cbrt(0.75 * cells.volumes[g] / pi));
        const int first = static_cast<int>(b.meshes.node_offsets[g]);
        for (int n = 0; n < grains.nodes_of(g); ++n) {
            const int vertex = b.meshes.node_vertices[first + n];
            set_space_vector(grains.reference, grains.node(g, n),
                vertex < 0 ? cells.centres[g] : cells.vertices[vertex]);
        }
        // rigid grains need none, and their materials may have no modulus
        const PlaneStiffness c =
            b.input.rigid ? PlaneStiffness {} : solid_stiffness(grains.elastic[grains.material[g]]);
        const int row = row_count<PlaneStiffness> * lanes * grains.block_of(g);
        for (int l = 0; l < lanes; ++l)
            store_rows(c, &grains.stiffness[row], l);
    }
}

void store_shape(const TetrahedronShape& shape, double* rows, int lane)
{
    int row = 0;
    for (const Vector& g : { shape.g1, shape.g2, shape.g3 })
        for (const double value : { g.x, g.y, g.z })
            rows[lanes * row++ + lane] = value;
    rows[lanes * row + lane] = shape.volume;
}

/// Tetrahedra of a grain, neighbours of its fan in different batches, since a batch adds to one
/// node after the other.
void add_tetrahedra(Building& b, int grain)
{
    Tetrahedra& t = b.state.tetrahedra;
    const Grains& grains = b.state.grains;
    const int from = static_cast<int>(b.meshes.element_offsets[grain]);
    const int count = static_cast<int>(b.meshes.element_offsets[grain + 1]) - from;
    const int batches = blocks_of(count), first = t.first.back();
    t.first.push_back(first + batches);
    t.nodes.resize(static_cast<std::size_t>(t.batches()) * Tetrahedra::corners * lanes);
    t.shape.resize(static_cast<std::size_t>(t.batches()) * Tetrahedra::rows * lanes);
    for (int i = 0; i < batches * lanes; ++i) {
        const auto& nodes = b.meshes.elements[from + std::min(i, count - 1)];
        std::array<Vector, 4> r;
        for (int k = 0; k < 4; ++k)
            r[k] = space_vector(grains.reference, grains.node(grain, nodes[k]));
        TetrahedronShape shape = tetrahedron_shape(r[0], r[1], r[2], r[3]);
        if (i >= count) shape.volume = 0.0;
        const int batch = first + i % batches, lane = i / batches;
        for (int k = 0; k < Tetrahedra::corners; ++k)
            t.nodes[(batch * Tetrahedra::corners + k) * lanes + lane] = node_values * nodes[k + 1];
        store_shape(shape, &t.shape[batch * Tetrahedra::rows * lanes], lane);
    }
}

/// A contact on its way into a block: corners from where the line begins.
struct FaceOnTheWay {
    FaceGroup group;
    std::vector<int> vertices;
    int line;                       ///< corner at the end of the line
    std::vector<FacePoint> points;  ///< shares by these corners
};

bool is_corner(const FacePoint& point, int corner)
{
    constexpr double round_off = 1e-12;
    for (std::size_t k = 0; k < point.shares.size(); ++k) {
        const double own = static_cast<int>(k) == corner ? 1.0 : 0.0;
        if (std::fabs(point.shares[k] - own) > round_off) return false;
    }
    return true;
}

FaceOnTheWay read_face(const Building& b, int face)
{
    const std::vector<int> vertices = b.cells.corners(face);
    const int n = static_cast<int>(vertices.size());
    if (n > most_corners) {
        refuse("make_solid: corners of a face", static_cast<double>(n), "",
            "must be at most " + std::to_string(most_corners)
                + "; collapse longer edges, or use fewer joints or smaller grains");
    }
    std::vector<Vector> places;
    for (int v : vertices)
        places.push_back(b.cells.vertices[v]);
    FaceOnTheWay result;
    result.points = face_points(places, b.input.rule).points;
    const int points = static_cast<int>(result.points.size());
    bool at_corners = points >= n;
    for (int k = 0; k < n && at_corners; ++k)
        at_corners = is_corner(result.points[k], k);
    result.group = { n, points, at_corners ? n : 0 };
    const auto [from, to] = farthest_corners(places);
    result.line = to - from;
    if (at_corners)
        std::rotate(result.points.begin(), result.points.begin() + from, result.points.begin() + n);
    for (FacePoint& p : result.points)
        std::rotate(p.shares.begin(), p.shares.begin() + from, p.shares.end());
    result.vertices = vertices;
    std::rotate(result.vertices.begin(), result.vertices.begin() + from, result.vertices.end());
    return result;
}

/// Put a contact into a slot; `area`: 0 in one that is padded.
void store_face(Building& b, const FaceOnTheWay& face, int contact, int slot, double area)
{
    FaceContacts& c = b.state.contacts;
    const int block = slot / lanes, lane = slot % lanes, corners = face.group.corners;
    for (int k = 0; k < corners; ++k) {
        const int v = face.vertices[k];
        for (int side = 0; side < 2; ++side) {
            const int row = 2 * k + side;
            c.nodes[c.block_nodes[block] + row * lanes + lane] = b.node(c.pairs[contact][side], v);
        }
        double* place = &c.places[c.block_nodes[block] / 2 * 3 + 3 * k * lanes + lane];
        const Vector p = b.cells.vertices[v];
        place[0] = p.x;
        place[lanes] = p.y;
        place[2 * lanes] = p.z;
    }
    c.line[slot] = face.line;
    for (int p = 0; p < face.group.points; ++p) {
        c.areas[c.block_points[block] + p * lanes + lane] = area * face.points[p].area;
        if (p < face.group.at_corners) continue;
        for (int k = 0; k < corners; ++k) {
            const int row = (p - face.group.at_corners) * corners + k;
            c.shares[c.block_shares[block] + row * lanes + lane] = face.points[p].shares[k];
        }
    }
}

/// Index of a group, which is added if it is new.
int group_index(FaceContacts& c, const FaceGroup& group)
{
    const auto found = std::find_if(c.groups.begin(), c.groups.end(),
        [&](const FaceGroup& other) { return !(other < group) && !(group < other); });
    const auto index = static_cast<int>(found - c.groups.begin());
    if (found == c.groups.end()) c.groups.push_back(group);
    return index;
}

/// Blocks of one group, and room for them.
void add_blocks(FaceContacts& c, const FaceGroup& group, int contacts)
{
    const int index = group_index(c, group);
    for (int k = 0; k < blocks_of(contacts); ++k) {
        c.block_group.push_back(index);
        c.block_nodes.push_back(c.block_nodes.back() + 2 * group.corners * lanes);
        c.block_points.push_back(c.block_points.back() + group.points * lanes);
        c.block_shares.push_back(
            c.block_shares.back() + (group.points - group.at_corners) * group.corners * lanes);
    }
    c.in_slot.resize(static_cast<std::size_t>(c.blocks()) * lanes, -1);
    c.line.resize(c.in_slot.size(), 0);
    const auto nodes = static_cast<std::size_t>(c.block_nodes.back());
    const auto points = static_cast<std::size_t>(c.block_points.back());
    c.nodes.resize(nodes, 0);
    c.places.resize(nodes / 2 * 3, 0.0);
    c.areas.resize(points, 0.0);
    c.states.resize(c.blocks());
    c.cracks.resize(c.blocks());
    c.shares.resize(c.block_shares.back(), 0.0);
}

/// Joint of a contact, -1: none.
int joint_of(const SolidInput& input, int face)
{
    return input.joint.empty() ? -1 : input.joint[face];
}

/// Index of the law of a contact; strengths of its own make it a law of its own.
int law_of_face(Building& b, const PolyhedronFace& on, int face)
{
    const SolidInput& input = b.input;
    const int joint = joint_of(input, face), pairs = static_cast<int>(input.contacts.size());
    const int law = joint >= 0 ? pairs + joint : b.state.grains.law_index(on.cell_a, on.cell_b);
    if (input.strength.empty()) return law;
    auto& laws = b.state.contacts.laws;
    const double factor = input.strength[face];
    laws.push_back(joint >= 0 ? joint_law(scaled_strength(input.joints[joint], factor))
                              : make_law(scaled_strength(input.contacts[law], factor)));
    return static_cast<int>(laws.size()) - 1;
}

/// Joints without strength are cracked from the start, and never count as cracks.
void crack_joints_from_start(Building& b)
{
    FaceContacts& c = b.state.contacts;
    for (int contact = 0; contact < c.count; ++contact) {
        const int joint = joint_of(b.input, contact);
        if (joint >= 0 && is_cracked(b.input.joints[joint])) crack_from_start(c, contact);
    }
}

void add_contacts(Building& b)
{
    FaceContacts& c = b.state.contacts;
    for (const ContactMaterial& m : b.input.contacts)
        c.laws.push_back(make_law(m));
    for (const ContactMaterial& m : b.input.joints)
        c.laws.push_back(joint_law(m));
    c.count = b.cells.contacts;
    c.joint = b.input.joint;
    c.slot.resize(c.count);
    c.block_nodes = c.block_points = c.block_shares = { 0 };
    const CurveOrder curve(b.solid);
    std::vector<std::uint64_t> keys;
    std::vector<FaceOnTheWay> faces;
    for (int f = 0; f < c.count; ++f) {
        const PolyhedronFace& on = b.cells.faces[f];
        c.pairs.push_back({ on.cell_a, on.cell_b });
        c.law.push_back(law_of_face(b, on, f));
        faces.push_back(read_face(b, f));
        keys.push_back(
            curve.number(0.5 * (b.cells.centres[on.cell_a] + b.cells.centres[on.cell_b])));
    }
    std::map<std::tuple<int, bool, FaceGroup>, std::vector<int>> groups;
    for (int f : sorted_by(keys))
        groups[{ tile_of(b.state, f), reaches_out(b.state, f), faces[f].group }].push_back(f);
    for (const auto& [key, members] : groups) {
        const FaceGroup& group = std::get<FaceGroup>(key);
        const int first = c.blocks() * lanes;
        add_blocks(c, group, static_cast<int>(members.size()));
        for (int slot = first; slot < c.blocks() * lanes; ++slot) {
            const int i = slot - first, last = static_cast<int>(members.size()) - 1;
            const int contact = members[std::min(i, last)];
            store_face(b, faces[contact], contact, slot, i <= last ? 1.0 : 0.0);
            if (i > last) continue;
            c.in_slot[slot] = contact;
            c.slot[contact] = slot;
        }
    }
}

/// Side that a wall belongs to; the next hole is one more.
int side_of_wall(const Building& b, int wall)
{
    if (wall < static_cast<int>(b.solid.walls.size()))
        return static_cast<int>(b.solid.walls[wall].side);
    if (wall < b.cells.first_hole) return static_cast<int>(SolidSide::notch);
    return static_cast<int>(SolidSide::hole) + wall - b.cells.first_hole;
}

void add_surface(Building& b)
{
    SurfaceTriangles& surface = b.state.surface;
    for (std::size_t f = 0; f < b.cells.faces.size(); ++f) {
        const PolyhedronFace& on = b.cells.faces[f];
        if (on.cell_b >= 0) continue;
        const int side = side_of_wall(b, on.wall);
        const auto corners = b.cells.corners(static_cast<int>(f));
        for (const auto& [p, q, r] : face_triangles(b.cells.vertices, corners)) {
            surface.grain.push_back(on.cell_a);
            surface.side.push_back(side);
            surface.nodes.push_back(
                { b.node(on.cell_a, p), b.node(on.cell_a, q), b.node(on.cell_a, r) });
        }
    }
}

void size_ledger(EnergyLedger& ledger, int blocks)
{
    for (auto* works : { &ledger.damping_work, &ledger.drag_work, &ledger.prescribed_work })
        works->assign(2 * static_cast<std::size_t>(blocks), 0.0);
    ledger.kinetic.assign(blocks, 0.0);
    ledger.largest_force.assign(blocks, 0.0);
}

/// Give back what arrays that grew block by block have to spare: up to half of the state.
void fit(Tetrahedra& t, FaceContacts& c)
{
    t.nodes.shrink_to_fit();
    t.shape.shrink_to_fit();
    for (auto* values : { &c.places, &c.areas, &c.shares })
        values->shrink_to_fit();
    c.nodes.shrink_to_fit();
}

}  // namespace

SolidState make_solid(const Polyhedra& cells, const Solid& solid, const SolidInput& input)
{
    check_input(cells, input);
    Building b { cells, solid, input, fan_meshes(cells), {} };
    add_grains(b);
    SolidState& s = b.state;
    s.tetrahedra.first = { 0 };
    for (int block = 0; block < s.grains.blocks(); ++block)
        add_tetrahedra(b, s.grains.in_slot[block * lanes]);
    add_contacts(b);
    crack_joints_from_start(b);
    fit(s.tetrahedra, s.contacts);
    add_surface(b);
    size_ledger(s.ledger, s.grains.blocks());
    if (input.rigid) s.bodies.resize(s.grains.count);
    s.loading.grains.velocity.assign(s.grains.velocity.size(), 0.0);
    s.loading.grains.spin.assign(3 * s.bodies.size(), 0.0);
    prepare_step(s);
    set_real_masses(s);
    return std::move(b.state);
}

}  // namespace flexpm
