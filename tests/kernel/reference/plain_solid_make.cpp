// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Plain solid specimens of cells, and their masses.
#include "reference/plain_solid.hpp"

#include <flexpm/kernel/space/face_frame.hpp>
#include <flexpm/kernel/space/fan_meshes.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace plain_solid {

namespace {

/// Number of the node of a grain at a vertex of the cells.
struct Corners {
    const flexpm::FanMeshes& meshes;
    bool joined;

    int operator()(int grain, int vertex) const
    {
        if (joined) return vertex;
        const auto first = meshes.node_vertices.begin() + meshes.node_offsets[grain];
        const auto last = meshes.node_vertices.begin() + meshes.node_offsets[grain + 1] - 1;
        return static_cast<int>(
            std::lower_bound(first, last, vertex) - meshes.node_vertices.begin());
    }
};

void add_grain(Specimen& s, const flexpm::Polyhedra& cells, const flexpm::FanMeshes& meshes,
    int cell, const Making& making)
{
    Grain g;
    g.radius = std::cbrt(0.75 * cells.volumes[cell] / flexpm::pi);
    for (auto k = meshes.node_offsets[cell]; k < meshes.node_offsets[cell + 1]; ++k) {
        const int vertex = meshes.node_vertices[k];
        const bool is_centre = vertex < 0;
        g.nodes.push_back(!making.joined ? static_cast<int>(k)
                : is_centre              ? static_cast<int>(cells.vertices.size()) + cell
                                         : vertex);
        Node& node = s.nodes[g.nodes.back()];
        node.reference = is_centre ? cells.centres[cell] : cells.vertices[vertex];
        node.rides = making.rigid && !is_centre;
    }
    for (auto e = meshes.element_offsets[cell]; e < meshes.element_offsets[cell + 1]; ++e) {
        std::array<int, 4> nodes {};
        for (int k = 0; k < 4; ++k)
            nodes[k] = g.nodes[meshes.elements[e][k]];
        g.elements.push_back(nodes);
    }
    s.grains.push_back(g);
}

void add_contact(Specimen& s, const flexpm::Polyhedra& cells, int face, const Corners& node,
    const flexpm::LawParameters& law, flexpm::FacePointRule rule)
{
    Contact c;
    c.grains = { cells.faces[face].cell_a, cells.faces[face].cell_b };
    c.law = law;
    std::vector<Vector> corners;
    for (int v : cells.corners(face)) {
        corners.push_back(cells.vertices[v]);
        for (int side = 0; side < 2; ++side)
            c.corners[side].push_back(node(c.grains[side], v));
    }
    c.line = flexpm::farthest_corners(corners);
    for (const auto& p : flexpm::face_points(corners, rule).points)
        c.points.push_back({ p.area, p.shares, {}, {}, {} });
    s.contacts.push_back(c);
}

/// Bound of the norm of a block.
double norm_of(const flexpm::SpaceGradient& k)
{
    const auto sum = [](double a, double b, double c) {
        return std::fabs(a) + std::fabs(b) + std::fabs(c);
    };
    const double rows =
        std::max({ sum(k.x.x, k.x.y, k.x.z), sum(k.y.x, k.y.y, k.y.z), sum(k.z.x, k.z.y, k.z.z) });
    const double columns =
        std::max({ sum(k.x.x, k.y.x, k.z.x), sum(k.x.y, k.y.y, k.z.y), sum(k.x.z, k.y.z, k.z.z) });
    return std::sqrt(rows * columns);
}

/// Sums of the norms of the blocks in each row: of nodes [N/m], of turns of rigid grains times
/// their radius squared [N m].
struct Bound {
    std::vector<double> node, turn;
};

void add_elements(const Specimen& s, Bound& bound)
{
    std::map<std::array<int, 2>, flexpm::SpaceGradient> blocks;
    for (const Grain& g : s.grains) {
        for (const auto& e : g.elements) {
            const auto shape = flexpm::tetrahedron_shape(s.nodes[e[0]].reference,
                s.nodes[e[1]].reference, s.nodes[e[2]].reference, s.nodes[e[3]].reference);
            for (int i = 0; i < 4; ++i) {
                for (int k = 0; k < 4; ++k) {
                    const auto block = flexpm::stiffness_block(shape, s.elastic, i, k);
                    auto& sum = blocks[{ e[i], e[k] }];
                    sum = { sum.x + block.x, sum.y + block.y, sum.z + block.z };
                }
            }
        }
    }
    for (const auto& [nodes, block] : blocks)
        bound.node[nodes[0]] += norm_of(block);
}

void add_contact_bound(const Specimen& s, const Contact& c, Bound& bound)
{
    const double stiffness = std::max(c.law.normal_stiffness, c.law.shear_stiffness);
    for (const ContactPoint& p : c.points) {
        double sum[2] = { 0.0, 0.0 }, arm[2] = { 0.0, 0.0 };
        for (int side = 0; side < 2; ++side) {
            const Grain& g = s.grains[c.grains[side]];
            Vector place;
            for (std::size_t k = 0; k < p.shares.size(); ++k) {
                sum[side] += std::fabs(p.shares[k]);
                place = place + p.shares[k] * s.nodes[c.corners[side][k]].reference;
            }
            if (!g.is_rigid()) continue;
            arm[side] = norm(place - s.nodes[g.centre()].reference) / g.radius;
            sum[side] = 1.0 + arm[side];
        }
        const double all = p.area * stiffness * (sum[0] + sum[1]);
        for (int side = 0; side < 2; ++side) {
            const int grain = c.grains[side];
            const Grain& g = s.grains[grain];
            if (g.is_rigid()) {
                bound.node[g.centre()] += all;
                bound.turn[grain] += g.radius * g.radius * arm[side] * all;
                continue;
            }
            for (std::size_t k = 0; k < p.shares.size(); ++k)
                bound.node[c.corners[side][k]] += std::fabs(p.shares[k]) * all;
        }
    }
}

}  // namespace

Specimen make_specimen(const flexpm::Polyhedra& cells, const flexpm::ElasticMaterial& grain,
    const flexpm::ContactMaterial& contact, const Making& making)
{
    Specimen s;
    s.elastic = flexpm::solid_stiffness(grain);
    s.density = grain.density;
    const flexpm::FanMeshes meshes = flexpm::fan_meshes(cells);
    s.nodes.resize(
        making.joined ? cells.vertices.size() + cells.cells() : meshes.node_vertices.size());
    for (int c = 0; c < cells.cells(); ++c)
        add_grain(s, cells, meshes, c, making);
    give_real_masses(s);
    if (making.rigid) {
        for (Grain& g : s.grains)
            g.elements.clear();
    }
    if (making.joined) return s;
    const auto law = flexpm::make_law(contact);
    for (int f = 0; f < cells.contacts; ++f)
        add_contact(s, cells, f, { meshes, making.joined }, law, making.rule);
    return s;
}

void scale_masses(Specimen& s, double dt, double damping)
{
    Bound bound { std::vector<double>(s.nodes.size(), 0.0),
        std::vector<double>(s.grains.size(), 0.0) };
    add_elements(s, bound);
    for (const Contact& c : s.contacts)
        add_contact_bound(s, c, bound);
    const double factor = 1.1 * (1.0 + damping) * dt * dt / 4.0;
    for (std::size_t n = 0; n < s.nodes.size(); ++n)
        s.nodes[n].mass = factor * bound.node[n];
    for (std::size_t g = 0; g < s.grains.size(); ++g) {
        const double i = factor * bound.turn[g];
        s.grains[g].inertia = { i, i, i, 0.0, 0.0, 0.0 };
    }
}

void give_real_masses(Specimen& s)
{
    for (Node& n : s.nodes)
        n.mass = 0.0;
    for (Grain& g : s.grains) {
        const Vector centre = s.nodes[g.centre()].reference;
        flexpm::SpaceTensor moments {};
        for (const auto& e : g.elements) {
            std::array<Vector, 4> r;
            for (int k = 0; k < 4; ++k)
                r[k] = s.nodes[e[k]].reference - centre;
            const double volume = triple(r[1] - r[0], r[2] - r[0], r[3] - r[0]) / 6.0;
            for (int n : e)
                s.nodes[n].mass += 0.25 * s.density * volume;
            const auto m = flexpm::second_moments(r[0], r[1], r[2], r[3]);
            moments = { moments.xx + m.xx, moments.yy + m.yy, moments.zz + m.zz, moments.yz + m.yz,
                moments.xz + m.xz, moments.xy + m.xy };
        }
        const auto i = flexpm::inertia_of(moments);
        const double d = s.density;
        g.inertia = { d * i.xx, d * i.yy, d * i.zz, d * i.yz, d * i.xz, d * i.xy };
    }
    for (Grain& g : s.grains) {
        Node& centre = s.nodes[g.centre()];
        for (int n : g.nodes) {
            if (!s.nodes[n].rides) continue;
            centre.mass += s.nodes[n].mass;
            s.nodes[n].mass = 0.0;
        }
    }
}

}  // namespace plain_solid
