// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Building the packed arrays.
#include <flexpm/kernel/topology/assembly_build.hpp>

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/step/step_plan.hpp>

#include <algorithm>
#include <array>
#include <cmath>
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

/// Grains of equal connectivity by eights. Blocks follow the order of the grains, which is one in space,
/// and not that of the groups: what a step reads together then lies together.
std::vector<Block> group_grains(Assembly& a, const std::vector<MeshedGrain>& grains)
{
    std::map<std::pair<int, std::vector<int>>, std::vector<int>> members;
    for (int g = 0; g < a.grains; ++g) {
        std::vector<int> triangles;
        for (const auto& t : grains[g].mesh.triangles)
            triangles.insert(triangles.end(), t.begin(), t.end());
        members[{ static_cast<int>(grains[g].vertices.size()), triangles }].push_back(g);
    }
    std::vector<Block> blocks;
    for (const auto& [key, ids] : members) {
        const int group = static_cast<int>(a.groups.size());
        a.groups.push_back({ key.first, static_cast<int>(grains[ids.front()].mesh.nodes.size()),
            key.second, key.second.empty() });
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
    a.grain_slot.assign(a.grains, -1);
    for (const Block& b : group_grains(a, grains)) {
        const MeshGroup& group = a.groups[b.group];
        for (int l = 0; l < lanes; ++l) {
            const bool real = l < static_cast<int>(b.grains.size());
            a.slot_grain.push_back(real ? b.grains[l] : -1);
            if (real) a.grain_slot[b.grains[l]] = a.blocks() * lanes + l;
        }
        a.block_group.push_back(b.group);
        a.block_nodes.push_back(nodes);
        a.block_triangles.push_back(triangles);
        nodes += 2 * lanes * group.nodes;
        triangles += 5 * lanes * static_cast<int>(group.triangles.size() / 3);
    }
    for (auto* array : { &a.reference, &a.displacement, &a.velocity, &a.force })
        array->assign(nodes, 0.0);
    a.held.assign(nodes, 0);
    a.inverse_mass.assign(nodes / 2, 0.0);
    a.shape.assign(triangles, 0.0);
    a.stiffness.assign(3 * lanes * a.blocks(), 0.0);
    a.rotation.assign(3 * lanes * a.blocks(), 0.0);
    a.spin.assign(lanes * a.blocks(), 0.0);
    a.inverse_inertia.assign(lanes * a.blocks(), 0.0);
    a.spin_held.assign(lanes * a.blocks(), 0);
    a.damping_work.assign(2 * a.blocks(), 0.0);
    a.driven_work.assign(2 * a.blocks(), 0.0);
    a.kinetic.assign(a.blocks(), 0.0);
    a.largest_force.assign(a.blocks(), 0.0);
}

/// One slot: a grain, or in a padded lane a held copy of the block's first grain without stiffness.
void fill_slot(Assembly& a, int slot, const std::vector<MeshedGrain>& grains)
{
    const bool real = a.slot_grain[slot] >= 0;
    const int block = slot / lanes, lane = slot % lanes;
    const int g = real ? a.slot_grain[slot] : a.slot_grain[block * lanes];
    const GrainMesh& mesh = grains[g].mesh;
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
        const int node = a.block_nodes[block] + 2 * lanes * static_cast<int>(n) + lane;
        a.reference[node] = mesh.nodes[n].x;
        a.reference[node + lanes] = mesh.nodes[n].y;
        a.held[node] = a.held[node + lanes] = !real;
    }
    a.spin_held[slot] = !real;
    if (mesh.triangles.empty()) return;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto& t = mesh.triangles[i];
        const TriangleShape s =
            triangle_shape(mesh.nodes[t[0]], mesh.nodes[t[1]], mesh.nodes[t[2]], a.thickness);
        double* row = &a.shape[a.block_triangles[block] + 5 * lanes * i + lane];
        row[0] = s.g1x;
        row[lanes] = s.g1y;
        row[2 * lanes] = s.g2x;
        row[3 * lanes] = s.g2y;
        row[4 * lanes] = real ? s.volume : 0.0;
    }
    const PlaneStiffness c = plane_stiffness(a.elastic[a.grain_material[g]]);
    double* row = &a.stiffness[3 * lanes * block + lane];
    row[0] = c.normal;
    row[lanes] = c.cross;
    row[2 * lanes] = c.shear;
}

/// Place and share of area of each point along an edge: Lobatto, paper Sec. 2.5.
struct EdgePoints {
    std::array<double, 3> weight;
    std::array<double, 3> share;
};

EdgePoints edge_points(int points)
{
    if (points == 1) return { { 0.5 }, { 1.0 } };
    if (points == 2) return { { 0.0, 1.0 }, { 0.5, 0.5 } };
    return { { 0.0, 0.5, 1.0 }, { 1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0 } };
}

/// Weight of the edge's end for the point where Eq. 7 with d_v = 0 puts it: between the two discs,
/// in the middle of their overlap. It may lie beyond the edge: weights then extrapolate.
double centre_line_weight(Point p0, Point p1, const Disc& a, const Disc& b)
{
    const double dx = b.centre.x - a.centre.x, dy = b.centre.y - a.centre.y;
    const double d = std::hypot(dx, dy);
    const double reach = a.radius - 0.5 * (a.radius + b.radius - d);
    const double x = a.centre.x + reach * dx / d, y = a.centre.y + reach * dy / d;
    const double ex = p1.x - p0.x, ey = p1.y - p0.y;
    return ((x - p0.x) * ex + (y - p0.y) * ey) / (ex * ex + ey * ey);
}

int node_of_vertex(const Assembly& a, const std::vector<MeshedGrain>& grains, int grain, int vertex)
{
    const auto& v = grains[grain].vertices;
    return a.node(grain, static_cast<int>(std::find(v.begin(), v.end(), vertex) - v.begin()));
}

/// Rows of contact `c` from shared edge `e` (padded contacts repeat the last edge, without area).
void fill_contact(Assembly& a, int c, const SharedEdge& e, const std::vector<MeshedGrain>& grains,
    const EdgePoints& points, bool of_edge)
{
    const bool real = c < a.contacts;
    const int nodes[] = { node_of_vertex(a, grains, e.cell_a, e.vertex_0),
        node_of_vertex(a, grains, e.cell_a, e.vertex_1),
        node_of_vertex(a, grains, e.cell_b, e.vertex_0),
        node_of_vertex(a, grains, e.cell_b, e.vertex_1), a.centre_slot(e.cell_a),
        a.centre_slot(e.cell_b) };
    for (int i = 0; i < ContactRows::nodes; ++i) {
        a.contact_nodes[row_index(c, i, ContactRows::nodes)] = nodes[i];
    }
    const Point p0 = a.position(nodes[0]), p1 = a.position(nodes[1]);
    const double area = std::hypot(p1.x - p0.x, p1.y - p0.y) * a.thickness;
    for (int p = 0; p < a.points; ++p) {
        a.area[row_index(c, p, a.points)] = real ? points.share[p] * area : 0.0;
        for (int side = 0; side < 2; ++side) {
            a.weight[row_index(c, 2 * p + side, 2 * a.points)] = points.weight[p];
        }
    }
    const Point ca = a.position(a.centre(e.cell_a)), cb = a.position(a.centre(e.cell_b));
    a.span[row_index(c, 0, 2)] = of_edge ? 0.0 : cb.x - ca.x;
    a.span[row_index(c, 1, 2)] = of_edge ? 0.0 : cb.y - ca.y;
    const Point n = bonded_normal(a, c);
    a.normal[row_index(c, 0, 2)] = n.x;
    a.normal[row_index(c, 1, 2)] = n.y;
    const double along = (p1.y - p0.y) * n.x - (p1.x - p0.x) * n.y;
    a.edge_reach[row_index(c, 0, 2)] = a.edge_reach[row_index(c, 1, 2)] = 1.0 / along;
}

void size_contacts(Assembly& a)
{
    const int padded = a.contact_blocks() * lanes;
    visit_contact_rows(a, [&](auto& values, int rows, auto) {
        values.assign(static_cast<std::size_t>(padded) * rows, 0);
    });
    std::fill(a.crack_step.begin(), a.crack_step.end(), -1);
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
    std::set<std::pair<int, int>> bonded;
    for (const SharedEdge& e : t.shared_edges)
        bonded.insert({ e.cell_a, e.cell_b });
    for (const auto& cells : cells_at) {
        for (int g : cells) {
            for (int h : cells) {
                if (g >= h || bonded.count({ g, h })) continue;
                const Point p = a.position(a.centre(g)), q = a.position(a.centre(h));
                const double d = std::hypot(q.x - p.x, q.y - p.y);
                if (d < a.radius[g] + a.radius[h]) a.close_pairs[{ g, h }] = d;
            }
        }
    }
}

void bond(Assembly& a, const Tessellation& t, const std::vector<Disc>& discs,
    const std::vector<MeshedGrain>& grains, const AssemblyOptions& options)
{
    a.contacts = static_cast<int>(t.shared_edges.size());
    size_contacts(a);
    EdgePoints points = edge_points(a.points);
    const int materials = static_cast<int>(options.elastic.size());
    for (int c = 0; c < a.contact_blocks() * lanes; ++c) {
        const SharedEdge& e = t.shared_edges[std::min(c, a.contacts - 1)];
        if (options.on_centre_line) {
            points.weight[0] = centre_line_weight(t.vertices[e.vertex_0], t.vertices[e.vertex_1],
                discs[t.disc_of_cell[e.cell_a]], discs[t.disc_of_cell[e.cell_b]]);
        }
        const int edge = std::min(c, a.contacts - 1);
        const bool of_edge = !options.edge_normal.empty() && options.edge_normal[edge] != 0;
        fill_contact(a, c, e, grains, points, of_edge);
        if (c >= a.contacts) continue;
        a.contact_grains.insert(a.contact_grains.end(), { e.cell_a, e.cell_b });
        a.contact_bonded.push_back(1);
        a.contact_law.push_back(!options.edge_law.empty()
                ? options.edge_law[c]
                : a.grain_material[e.cell_a] * materials + a.grain_material[e.cell_b]);
    }
}

void lay_out_edges(Assembly& a, const Tessellation& t, const std::vector<MeshedGrain>& grains)
{
    a.edges = static_cast<int>(t.boundary_edges.size());
    a.edge_nodes.assign(a.edge_blocks() * lanes * 2, 0);
    a.edge_force.assign(a.edge_blocks() * lanes * ContactRows::forces, 0.0);
    a.edge_pressure.assign(a.edges, 0.0);
    for (int i = 0; i < a.edges; ++i) {
        const BoundaryEdge& e = t.boundary_edges[i];
        a.edge_grain.push_back(e.cell);
        a.edge_side.push_back(e.side);
        a.edge_nodes[row_index(i, 0, 2)] = node_of_vertex(a, grains, e.cell, e.vertex_0);
        a.edge_nodes[row_index(i, 1, 2)] = node_of_vertex(a, grains, e.cell, e.vertex_1);
    }
}

void check_edges(const Tessellation& t, const AssemblyOptions& o)
{
    for (std::size_t given : { o.edge_law.size(), o.edge_normal.size() }) {
        if (given != 0 && given != t.shared_edges.size()) {
            refuse("choices for edges", static_cast<double>(given), "",
                "must be one for each shared edge");
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
    if (o.points < 1 || o.points > 3) refuse("contact points", o.points, "", "must be 1, 2 or 3");
    if (o.on_centre_line && o.points != 1) {
        refuse("contact points", o.points, "", "must be 1 when the point lies on the centre line");
    }
    const std::size_t materials = o.elastic.size();
    if (materials == 0) refuse("materials", 0, "", "give at least one");
    check_edges(t, o);
    if (o.edge_law.empty() && o.laws.size() != materials * materials) {
        refuse("contact laws", static_cast<double>(o.laws.size()), "",
            "must be one for each ordered pair of materials");
    }
    if (!o.grain_material.empty() && static_cast<int>(o.grain_material.size()) != t.cells()) {
        refuse("grain materials", static_cast<double>(o.grain_material.size()), "",
            "must be one for each grain");
    }
    if (!o.aggregate.empty() && static_cast<int>(o.aggregate.size()) != t.cells()) {
        refuse("grains of particles", static_cast<double>(o.aggregate.size()), "",
            "must be one for each cell");
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
    check(t, options);
    Assembly a;
    a.grains = t.cells();
    a.points = options.points;
    a.thickness = options.thickness;
    a.elastic = options.elastic;
    a.grain_material = options.grain_material;
    a.grain_material.resize(a.grains, 0);
    a.aggregate = options.aggregate;
    if (a.aggregate.empty()) {
        a.aggregate.resize(a.grains);
        std::iota(a.aggregate.begin(), a.aggregate.end(), 0);
    }
    for (const auto& law : options.laws)
        a.laws.push_back(make_law(law));
    std::vector<MeshedGrain> grains;
    for (int c = 0; c < a.grains; ++c) {
        grains.push_back(mesh_cell(t, discs, c, options));
        a.radius.push_back(discs[t.disc_of_cell[c]].radius);
    }
    lay_out_grains(a, grains);
    for (int slot = 0; slot < a.blocks() * lanes; ++slot)
        fill_slot(a, slot, grains);
    bond(a, t, discs, grains, options);
    lay_out_edges(a, t, grains);
    prepare_step(a);
    find_close_pairs(a, t);
    return a;
}

}  // namespace flexpm
