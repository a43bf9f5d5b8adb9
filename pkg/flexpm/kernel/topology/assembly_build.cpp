// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Building the packed arrays.
#include <flexpm/kernel/topology/assembly_build.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/fem/edge_points.hpp>
#include <flexpm/kernel/geometry/disc_checks.hpp>
#include <flexpm/kernel/step/step_plan.hpp>
#include <flexpm/kernel/topology/joint_sides.hpp>
#include <flexpm/kernel/topology/unbonded.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <set>

namespace flexpm {

namespace {

/// The mesh of a grain and which of its nodes each vertex of the tessellation is.
struct MeshedGrain {
    GrainMesh mesh;
    std::vector<int> vertices;  ///< tessellation vertex of node 0, 1, ...
};

/// Corners and centre, no triangles.
GrainMesh rigid_mesh(std::vector<Point> polygon, Point centre)
{
    GrainMesh mesh;
    mesh.nodes = std::move(polygon);
    mesh.nodes.push_back(centre);
    return mesh;
}

MeshedGrain mesh_cell(
    const Tessellation& t, const std::vector<Disc>& discs, int cell, const AssemblyOptions& options)
{
    const int first = t.cell_offsets[cell], count = t.vertices_of(cell);
    const std::vector<Point> polygon = cell_polygon(t, cell);
    const Point centre = discs[t.disc_of_cell[cell]].centre;
    MeshedGrain grain { options.rigid ? rigid_mesh(polygon, centre)
                                      : make_grain_mesh(polygon, centre, options.mesh),
        {} };
    for (int i = 0; i < count; ++i) {
        grain.vertices.push_back(t.cell_vertices[first + (grain.mesh.first_vertex + i) % count]);
    }
    return grain;
}

/// Grains of one group that are stepped together.
struct Block {
    int group;
    std::vector<int> grains;
};

/// Grains of equal connectivity by eights. Blocks follow the order of the grains, which is one in
/// space, and not that of the groups: what a step reads together then lies together.
std::vector<Block> group_grains(Assembly& a, const std::vector<MeshedGrain>& grains)
{
    std::map<std::pair<int, std::vector<int>>, std::vector<int>> members;
    for (int g = 0; g < a.grains.count; ++g) {
        std::vector<int> triangles;
        for (const auto& t : grains[g].mesh.triangles)
            triangles.insert(triangles.end(), t.begin(), t.end());
        members[{ static_cast<int>(grains[g].vertices.size()), triangles }].push_back(g);
    }
    std::vector<Block> blocks;
    for (const auto& [key, ids] : members) {
        const int group = static_cast<int>(a.grains.groups.size());
        a.grains.groups.push_back(
            { key.first, static_cast<int>(grains[ids.front()].mesh.nodes.size()), key.second,
                key.second.empty() });
        for (auto first = ids.begin(); first != ids.end();) {
            const auto end = first + std::min<std::ptrdiff_t>(lanes, ids.end() - first);
            blocks.push_back({ group, { first, end } });
            first = end;
        }
    }
    std::sort(blocks.begin(), blocks.end(),
        [](const Block& b, const Block& c) { return b.grains.back() < c.grains.back(); });
    return blocks;
}

void lay_out_grains(Assembly& a, const std::vector<MeshedGrain>& grains)
{
    int nodes = 0, triangles = 0;
    a.grains.slot.assign(a.grains.count, -1);
    for (const Block& b : group_grains(a, grains)) {
        const MeshGroup& group = a.grains.groups[b.group];
        for (int l = 0; l < lanes; ++l) {
            const bool real = l < static_cast<int>(b.grains.size());
            a.grains.in_slot.push_back(real ? b.grains[l] : -1);
            if (real) a.grains.slot[b.grains[l]] = a.grains.blocks() * lanes + l;
        }
        a.grains.block_group.push_back(b.group);
        a.grains.block_nodes.push_back(nodes);
        a.grains.block_triangles.push_back(triangles);
        nodes += a.grains.layout.node_stride * group.nodes;
        triangles += shape_rows * lanes * group.triangle_count();
    }
    for (auto* array : { &a.grains.reference, &a.grains.displacement, &a.grains.velocity,
             &a.loading.grains.velocity, &a.grains.force })
        array->assign(nodes, 0.0);
    a.grains.prescribed.assign(nodes, 0);
    a.grains.inverse_mass.assign(nodes / a.grains.layout.dimension, 0.0);
    a.grains.shape.assign(triangles, 0.0);
    a.grains.stiffness.assign(stiffness_rows * lanes * a.grains.blocks(), 0.0);
    a.grains.rotation.assign(RotationRow::count * lanes * a.grains.blocks(), 0.0);
    a.grains.spin.assign(lanes * a.grains.blocks(), 0.0);
    a.loading.grains.spin.assign(lanes * a.grains.blocks(), 0.0);
    a.grains.inverse_inertia.assign(lanes * a.grains.blocks(), 0.0);
    a.grains.spin_prescribed.assign(lanes * a.grains.blocks(), 0);
    a.ledger.damping_work.assign(2 * a.grains.blocks(), 0.0);
    a.ledger.drag_work.assign(2 * a.grains.blocks(), 0.0);
    a.ledger.prescribed_work.assign(2 * a.grains.blocks(), 0.0);
    a.ledger.kinetic.assign(a.grains.blocks(), 0.0);
    a.ledger.largest_force.assign(a.grains.blocks(), 0.0);
}

/// One slot: a grain, or in a padded lane a held copy of the block's first grain without stiffness.
void fill_slot(Assembly& a, int slot, const std::vector<MeshedGrain>& grains)
{
    const bool real = a.grains.in_slot[slot] >= 0;
    const int block = slot / lanes, lane = slot % lanes;
    const int g = real ? a.grains.in_slot[slot] : a.grains.in_slot[block * lanes];
    const GrainMesh& mesh = grains[g].mesh;
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
        // the place of the slot, not of its grain: a padded lane stands beside it
        const int node =
            a.grains.block_nodes[block] + a.grains.layout.node_stride * static_cast<int>(n) + lane;
        a.grains.set_vector(a.grains.reference, node, mesh.nodes[n]);
        for (int axis = 0; axis < a.grains.layout.dimension; ++axis)
            a.grains.prescribed[a.grains.component(node, axis)] = !real;
    }
    a.grains.spin_prescribed[slot] = !real;
    if (mesh.triangles.empty()) return;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto& t = mesh.triangles[i];
        TriangleShape s =
            triangle_shape(mesh.nodes[t[0]], mesh.nodes[t[1]], mesh.nodes[t[2]], a.thickness);
        if (!real) s.volume = 0.0;
        double* rows = &a.grains.shape[a.grains.block_triangles[block]];
        store_rows(s, rows + shape_rows * lanes * i, lane);
    }
    store_rows(plane_stiffness(a.grains.elastic[a.grains.material[g]]),
        &a.grains.stiffness[stiffness_rows * lanes * block], lane);
}

/// Weight of the edge's end for the point where Eq. 7 with d_v = 0 puts it: between the two discs,
/// in the middle of their overlap. It may lie beyond the edge: weights then extrapolate.
double centre_line_weight(Point p0, Point p1, const Disc& a, const Disc& b)
{
    const double dx = b.centre.x - a.centre.x, dy = b.centre.y - a.centre.y;
    const double d = std::hypot(dx, dy);
    const double arm = a.radius - 0.5 * (a.radius + b.radius - d);
    const double x = a.centre.x + arm * dx / d, y = a.centre.y + arm * dy / d;
    const double ex = p1.x - p0.x, ey = p1.y - p0.y;
    return ((x - p0.x) * ex + (y - p0.y) * ey) / (ex * ex + ey * ey);
}

int node_of_vertex(
    const Grains& grains, const std::vector<MeshedGrain>& meshed, int grain, int vertex)
{
    const auto& v = meshed[grain].vertices;
    return grains.node(grain, static_cast<int>(std::find(v.begin(), v.end(), vertex) - v.begin()));
}

/// Rows of contact `c` from shared edge `e` (padded contacts repeat the last edge, without area).
void fill_contact(Assembly& a, int c, const SharedEdge& e, const std::vector<MeshedGrain>& grains,
    const EdgePoints& points, bool of_edge)
{
    const bool real = c < a.contacts.count;
    const int nodes[] = { node_of_vertex(a.grains, grains, e.cell_a, e.vertex_0),
        node_of_vertex(a.grains, grains, e.cell_a, e.vertex_1),
        node_of_vertex(a.grains, grains, e.cell_b, e.vertex_0),
        node_of_vertex(a.grains, grains, e.cell_b, e.vertex_1), a.grains.centre_place(e.cell_a),
        a.grains.centre_place(e.cell_b) };
    for (int row = 0; row < NodeRow::count; ++row)
        a.contacts.nodes[row_index(c, row, NodeRow::count)] = nodes[row];
    const Point p0 = a.grains.point_at(nodes[0]), p1 = a.grains.point_at(nodes[1]);
    const double area = a.area_of(norm(p1 - p0));
    for (int p = 0; p < a.contacts.points_of(c); ++p) {
        a.contacts.area(c, p) = real ? points.share[p] * area : 0.0;
        for (int side = 0; side < 2; ++side) {
            a.contacts.weight(c, p, side) = points.weight[p];
        }
    }
    const Point ca = a.grains.point_at(a.grains.centre(e.cell_a)),
                cb = a.grains.point_at(a.grains.centre(e.cell_b));
    a.contacts.set_branch(c, of_edge ? Point {} : cb - ca);
    const Point n = bonded_normal(a, c);
    a.contacts.set_normal(c, n);
    const double along = (p1.y - p0.y) * n.x - (p1.x - p0.x) * n.y;
    a.contacts.inverse_edge_length(c, 0) = a.contacts.inverse_edge_length(c, 1) = 1.0 / along;
}

void size_contacts(Contacts& contacts)
{
    const std::size_t padded = static_cast<std::size_t>(contacts.blocks()) * lanes;
    Contacts::visit_rows(
        contacts, [&](auto& values, int rows, auto) { values.assign(padded * rows, 0); });
    std::fill(contacts.crack_steps.begin(), contacts.crack_steps.end(), -1);
    contacts.append_no_force();
}

/// Grains that meet in a point, share no edge, and whose discs overlap: they touch later.
void find_close_pairs(Assembly& a, const Tessellation& t)
{
    std::vector<std::vector<int>> cells_at(t.vertices.size());
    for (int c = 0; c < t.cells(); ++c) {
        for (int i = t.cell_offsets[c]; i < t.cell_offsets[c + 1]; ++i) {
            cells_at[t.cell_vertices[i]].push_back(c);
        }
    }
    std::set<GrainPair> bonded;
    for (const SharedEdge& e : t.shared_edges)
        bonded.insert({ e.cell_a, e.cell_b });
    for (const auto& cells : cells_at) {
        for (int g : cells) {
            for (int h : cells) {
                if (g >= h || bonded.count({ g, h })) continue;
                const Point p = a.grains.point_at(a.grains.centre(g)),
                            q = a.grains.point_at(a.grains.centre(h));
                const double d = std::hypot(q.x - p.x, q.y - p.y);
                if (d < a.grains.radius[g] + a.grains.radius[h])
                    a.contacts.close_pairs[{ g, h }] = d;
            }
        }
    }
}

int joint_of(const AssemblyOptions& options, int edge)
{
    return options.edge_joint.empty() ? -1 : options.edge_joint[edge];
}

/// Index of the law of a shared edge; strengths of its own make it a law of its own.
int law_of_edge(Assembly& a, const SharedEdge& e, int edge, const AssemblyOptions& options)
{
    const int joint = joint_of(options, edge), pairs = static_cast<int>(options.laws.size());
    const int law = joint >= 0      ? pairs + joint
        : !options.edge_law.empty() ? options.edge_law[edge]
                                    : a.grains.law_index(e.cell_a, e.cell_b);
    if (options.edge_strength.empty()) return law;
    const double factor = options.edge_strength[edge];
    a.contacts.laws.push_back(joint >= 0 ? joint_law(scaled_strength(options.joints[joint], factor))
                                         : make_law(scaled_strength(options.laws[law], factor)));
    return static_cast<int>(a.contacts.laws.size()) - 1;
}

/// Eq. 5 holds for whole Laguerre cells, whose edges stand square to the line of the centres.
bool has_edge_normal(const Tessellation& t, const AssemblyOptions& options, int edge)
{
    if (!options.edge_normal.empty()) return options.edge_normal[edge] != 0;
    const SharedEdge& e = t.shared_edges[edge];
    return !t.is_laguerre(e.cell_a) || !t.is_laguerre(e.cell_b);
}

void bond(Assembly& a, const Tessellation& t, const std::vector<Disc>& discs,
    const std::vector<MeshedGrain>& grains, const AssemblyOptions& options)
{
    a.contacts.count = static_cast<int>(t.shared_edges.size());
    size_contacts(a.contacts);
    EdgePoints points = edge_points(a.contacts.group.points);
    for (int c = 0; c < a.contacts.blocks() * lanes; ++c) {
        const SharedEdge& e = t.shared_edges[std::min(c, a.contacts.count - 1)];
        if (options.on_centre_line) {
            points.weight[0] = centre_line_weight(t.vertices[e.vertex_0], t.vertices[e.vertex_1],
                discs[t.disc_of_cell[e.cell_a]], discs[t.disc_of_cell[e.cell_b]]);
        }
        const int edge = std::min(c, a.contacts.count - 1);
        const int joint = joint_of(options, edge);
        fill_contact(a, c, e, grains, points, joint >= 0 || has_edge_normal(t, options, edge));
        if (c >= a.contacts.count) continue;
        a.contacts.pairs.push_back({ e.cell_a, e.cell_b });
        a.contacts.id.push_back(a.contacts.next_id++);
        a.contacts.bonded.push_back(1);
        a.contacts.erased.push_back(0);
        a.contacts.joint.push_back(joint);
        a.contacts.law.push_back(law_of_edge(a, e, c, options));
        if (joint >= 0 && is_cracked(options.joints[joint])) crack_from_start(a.contacts, c);
    }
}

void lay_out_facets(Assembly& a, const Tessellation& t, const std::vector<MeshedGrain>& grains)
{
    a.facets.count = static_cast<int>(t.boundary_edges.size());
    a.facets.resize_rows();
    a.facets.pressure.assign(a.facets.count, 0.0);
    for (int i = 0; i < a.facets.count; ++i) {
        const BoundaryEdge& e = t.boundary_edges[i];
        a.facets.grain.push_back(e.cell);
        a.facets.side.push_back(e.side);
        a.facets.set_nodes(i,
            { node_of_vertex(a.grains, grains, e.cell, e.vertex_0),
                node_of_vertex(a.grains, grains, e.cell, e.vertex_1) });
    }
}

void check_edges(const Tessellation& t, const AssemblyOptions& o)
{
    for (std::size_t given :
        { o.edge_law.size(), o.edge_normal.size(), o.edge_joint.size(), o.edge_strength.size() }) {
        if (given != 0 && given != t.shared_edges.size()) {
            refuse("choices for edges", static_cast<double>(given), "",
                "must be one for each shared edge");
        }
    }
    for (int joint : o.edge_joint) {
        if (joint < -1 || joint >= static_cast<int>(o.joints.size())) {
            refuse("joint of an edge", joint, "", "must be the index of a joint, or -1");
        }
    }
    for (int law : o.edge_law) {
        if (law < 0 || law >= static_cast<int>(o.laws.size())) {
            refuse("law of an edge", law, "", "must be the index of a law");
        }
    }
}

void check(const Tessellation& t, const AssemblyOptions& o)
{
    check_positive("thickness", o.thickness, "m");
    if (o.points < 1 || o.points > 3)
        refuse("contact points", o.points, "", "must be 1, 2 or 3; choose one of them");
    if (o.on_centre_line && o.points != 1) {
        refuse("contact points", o.points, "",
            "must be 1 when the point lies on the centre line; leave it out");
    }
    const std::size_t materials = o.elastic.size();
    if (materials == 0) refuse("materials", 0, "", "give at least one");
    check_edges(t, o);
    // grains of any two materials may come to touch
    const std::size_t pairs = materials * materials;
    if (o.laws.size() < pairs || (o.edge_law.empty() && o.laws.size() != pairs)) {
        refuse("contact laws", static_cast<double>(o.laws.size()), "",
            "must be one for each ordered pair of materials");
    }
    if (!o.grain_material.empty() && static_cast<int>(o.grain_material.size()) != t.cells()) {
        refuse("grain materials", static_cast<double>(o.grain_material.size()), "",
            "must be one for each grain");
    }
    if (!o.parent.empty() && static_cast<int>(o.parent.size()) != t.cells()) {
        refuse("grains of particles", static_cast<double>(o.parent.size()), "",
            "must be one for each cell");
    }
    for (int grain : o.parent) {
        if (grain < 0 || grain >= t.cells()) {
            refuse("grain of a particle", grain, "", "must be the number of a grain, from 0");
        }
    }
    for (int m : o.grain_material) {
        if (m < 0 || m >= static_cast<int>(materials)) {
            refuse("grain material", m, "", "must be the index of a material");
        }
    }
}

}  // namespace

Assembly make_assembly(
    const Tessellation& t, const std::vector<Disc>& discs, const AssemblyOptions& options)
{
    require_disc_of_each_cell(t, discs);
    check(t, options);
    Assembly a;
    a.grains.count = t.cells();
    a.contacts.group.points = options.points;
    a.thickness = options.thickness;
    a.grains.elastic = options.elastic;
    a.grains.material = options.grain_material;
    a.grains.material.resize(a.grains.count, 0);
    a.grains.erased.resize(a.grains.count, 0);
    a.grains.loose.resize(a.grains.count, 0);
    a.grains.parent = options.parent;
    if (a.grains.parent.empty()) {
        a.grains.parent.resize(a.grains.count);
        std::iota(a.grains.parent.begin(), a.grains.parent.end(), 0);
    }
    for (const auto& law : options.laws)
        a.contacts.laws.push_back(make_law(law));
    for (const auto& joint : options.joints)
        a.contacts.laws.push_back(joint_law(joint));
    std::vector<MeshedGrain> grains;
    for (int c = 0; c < a.grains.count; ++c) {
        grains.push_back(mesh_cell(t, discs, c, options));
        a.grains.radius.push_back(discs[t.disc_of_cell[c]].radius);
    }
    lay_out_grains(a, grains);
    for (int slot = 0; slot < a.grains.blocks() * lanes; ++slot)
        fill_slot(a, slot, grains);
    bond(a, t, discs, grains, options);
    lay_out_facets(a, t, grains);
    prepare_step(a);
    find_close_pairs(a, t);
    part_sides_of_joints(a, t);
    return a;
}

}  // namespace flexpm
