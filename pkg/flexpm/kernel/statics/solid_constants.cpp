// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/statics/solid_constants.hpp>

#include <flexpm/kernel/space/face_triangles.hpp>
#include <flexpm/kernel/space/fan_meshes.hpp>
#include <flexpm/kernel/statics/linear_solid.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace flexpm {
namespace {

/// Part of the surface: a triangle on a wall.
struct Facet {
    std::array<int, 3> nodes;
    int wall;
    double area;
};

/// A solid and its surface.
struct SurfacedSolid {
    LinearSolid solid;
    std::vector<Facet> facets;
};

/// Number of kinds of grains.
/// @throws std::invalid_argument  for a property out of range or a kind that is not there
int check_kinds(const Polyhedra& cells, const SolidElasticities& materials)
{
    for (const SolidElasticity& pair : materials.pairs) {
        check_positive("solid_constants: normal_stiffness", pair.normal_stiffness, "Pa/m");
        check_positive("solid_constants: shear_ratio", pair.shear_ratio, "");
    }
    const auto pairs = static_cast<int>(materials.pairs.size());
    int kinds = 0;
    while (kinds * kinds < pairs)
        ++kinds;
    if (pairs == 0 || kinds * kinds != pairs)
        refuse("solid_constants: pairs of kinds", pairs, "", "must be a square above 0");
    if (!materials.kind.empty() && static_cast<int>(materials.kind.size()) != cells.cells()) {
        refuse("solid_constants: kinds given", static_cast<double>(materials.kind.size()), "",
            "must be those of " + std::to_string(cells.cells()) + " cells");
    }
    for (const int kind : materials.kind) {
        if (kind < 0 || kind >= kinds) {
            refuse("solid_constants: kind of a cell", kind, "",
                "must be from 0 to below " + std::to_string(kinds));
        }
    }
    return kinds;
}

SurfacedSolid make_grains(
    const Polyhedra& cells, const SolidElasticities& materials, FacePointRule rule)
{
    const int kinds = check_kinds(cells, materials);
    const auto kind_of = [&](int cell) {
        return materials.kind.empty() ? 0 : materials.kind[cell];
    };
    SurfacedSolid g;
    LinearSolid& solid = g.solid;
    for (int k = 0; k < kinds; ++k) {
        const SolidElasticity& own = materials.pairs[k * kinds + k];
        // a density is asked for, and has no part in statics
        solid.kinds.push_back(solid_stiffness({ own.young, own.poisson, 1.0, Plane::strain }));
    }
    const FanMeshes meshes = fan_meshes(cells);
    const auto node = [&](int cell, int vertex) {
        const auto first = meshes.node_vertices.begin() + meshes.node_offsets[cell];
        const auto last = meshes.node_vertices.begin() + meshes.node_offsets[cell + 1] - 1;
        return static_cast<int>(
            std::lower_bound(first, last, vertex) - meshes.node_vertices.begin());
    };
    for (int c = 0; c < cells.cells(); ++c) {
        const auto first = meshes.node_offsets[c];
        for (auto k = first; k < meshes.node_offsets[c + 1]; ++k) {
            const int vertex = meshes.node_vertices[k];
            solid.places.push_back(vertex < 0 ? cells.centres[c] : cells.vertices[vertex]);
        }
        for (auto e = meshes.element_offsets[c]; e < meshes.element_offsets[c + 1]; ++e) {
            std::array<int, 4> n {};
            for (int k = 0; k < 4; ++k)
                n[k] = static_cast<int>(first) + meshes.elements[e][k];
            solid.elements.push_back({ n,
                tetrahedron_shape(
                    solid.places[n[0]], solid.places[n[1]], solid.places[n[2]], solid.places[n[3]]),
                kind_of(c) });
        }
    }
    for (std::size_t f = 0; f < cells.faces.size(); ++f) {
        const PolyhedronFace& on = cells.faces[f];
        const std::vector<int> corners = cells.corners(static_cast<int>(f));
        if (on.cell_b < 0) {
            for (const auto& [p, q, r] : face_triangles(cells.vertices, corners)) {
                const double area = 0.5
                    * norm(cross(cells.vertices[q] - cells.vertices[p],
                        cells.vertices[r] - cells.vertices[p]));
                g.facets.push_back({ { node(on.cell_a, p), node(on.cell_a, q), node(on.cell_a, r) },
                    on.wall, area });
            }
            continue;
        }
        const SolidElasticity& material =
            materials.pairs[kind_of(on.cell_a) * kinds + kind_of(on.cell_b)];
        LinearSolid::Face face;
        face.normal_stiffness = material.normal_stiffness;
        face.shear_stiffness = material.shear_ratio * material.normal_stiffness;
        std::vector<Vector> places;
        for (int v : corners) {
            places.push_back(cells.vertices[v]);
            face.nodes[0].push_back(node(on.cell_a, v));
            face.nodes[1].push_back(node(on.cell_b, v));
        }
        const FacePoints points = face_points(places, rule);
        face.normal = points.normal;
        for (const FacePoint& p : points.points)
            face.springs.push_back(spring_at(p.area, p.shares));
        solid.faces.push_back(std::move(face));
    }
    solid.first_nodes.assign(meshes.node_offsets.begin(), meshes.node_offsets.end());
    solid.share_among(1);
    return g;
}

/// Whether a facet is a wall of a pore, which is free.
bool is_flank(const Facet& f, const Solid& solid)
{
    return f.wall >= static_cast<int>(solid.walls.size());
}

/// Nodes that lie on a side.
std::vector<std::uint8_t> nodes_on(const SurfacedSolid& g, const Solid& solid, SolidSide side)
{
    std::vector<std::uint8_t> on(g.solid.places.size(), 0);
    bool any = false;
    for (const Facet& f : g.facets) {
        if (is_flank(f, solid) || solid.walls[f.wall].side != side) continue;
        for (int n : f.nodes)
            on[n] = 1;
        any = true;
    }
    if (!any) {
        refuse("solid_constants: facets of an end", 0.0, "",
            "must be above 0; give cells of a solid with bottom and top");
    }
    return on;
}

/// @throws std::invalid_argument  for cells of another solid
void require_cells_of(const Solid& solid, const Polyhedra& cells, const SurfacedSolid& g)
{
    constexpr double alike = 1e-6;
    const int walls = static_cast<int>(solid.walls.size());
    bool has_pores = false;
    for (const Facet& f : g.facets) {
        has_pores = has_pores || f.wall == walls;
        if (f.wall < 0 || f.wall > walls) {
            refuse("solid_constants: wall of a facet", static_cast<double>(f.wall), "",
                "must be below " + std::to_string(walls)
                    + ", or that for the walls of pores; give "
                      "the solid of the cells");
        }
    }
    double volume = 0.0;
    for (double v : cells.volumes)
        volume += v;
    if (has_pores && volume < solid.volume) return;
    if (!(std::fabs(volume - solid.volume) <= alike * solid.volume)) {
        refuse("solid_constants: volume of the solid", solid.volume, "m^3",
            "must be that of the cells, " + number(volume) + "; give the solid of the cells");
    }
}

}  // namespace

SolidExtension solid_extension(const Polyhedra& cells, const Solid& solid,
    const SolidElasticities& materials, FacePointRule rule)
{
    const SurfacedSolid g = make_grains(cells, materials, rule);
    require_cells_of(solid, cells, g);
    const auto bottom = nodes_on(g, solid, SolidSide::bottom);
    const auto top = nodes_on(g, solid, SolidSide::top);
    const double height = solid.high.z - solid.low.z, section = solid.volume / height;
    // a strain of 1: the solution is linear
    const std::size_t size = 3 * g.solid.places.size();
    std::vector<std::uint8_t> held(size, 0);
    std::vector<double> given(size, 0.0), guess(size, 0.0), load(size, 0.0), forces(size, 0.0);
    for (std::size_t n = 0; n < g.solid.places.size(); ++n) {
        const double way = g.solid.places[n].z - solid.low.z;
        held[3 * n + 2] = bottom[n] | top[n];
        (held[3 * n + 2] ? given : guess)[3 * n + 2] = way;
    }
    g.solid.add(given.data(), load.data());
    for (double& f : load)
        f = -f;
    const FreeSolution found = solve_free(g.solid, held, load, guess);
    std::vector<double> u = given;
    for (std::size_t k = 0; k < size; ++k)
        u[k] += found.u[k];
    g.solid.add(u.data(), forces.data());
    double reaction = 0.0, widening = 0.0;
    for (std::size_t n = 0; n < g.solid.places.size(); ++n)
        if (top[n]) reaction += forces[3 * n + 2];
    // Gauss: the sum of both lateral strains times the volume. Where a pore is open to the side,
    // the strain is that of the rest of the side.
    const Vector middle = 0.5 * (solid.low + solid.high);
    double covered = 0.0;
    bool has_pores = false;
    for (const Facet& f : g.facets) {
        if (is_flank(f, solid)) {
            has_pores = true;
            continue;
        }
        const Wall& wall = solid.walls[f.wall];
        if (is_end(wall.side)) continue;
        covered += f.area * (wall.offset - dot(wall.normal, middle));
        for (int n : f.nodes)
            widening += f.area / 3.0 * dot(wall.normal, triple_at(u.data(), n));
    }
    const double volume = has_pores ? 0.5 * covered : solid.volume;
    SolidExtension result {
        { reaction / section, -0.5 * widening / volume, found.iterations, found.residual }, {}
    };
    for (int n = 0; n < static_cast<int>(g.solid.places.size()); ++n)
        result.field.push_back(triple_at(u.data(), n));
    return result;
}

SolidConstants solid_constants(const Polyhedra& cells, const Solid& solid,
    const SolidElasticities& materials, FacePointRule rule)
{
    return solid_extension(cells, solid, materials, rule).constants;
}

}  // namespace flexpm
