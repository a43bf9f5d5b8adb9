// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Small explicit specimens and the paper's material (Tables 1, 3 and 7) for the kernel's
/// tests. SI units, tension positive.
#pragma once

#include <flexpm/kernel/core/random.hpp>
#include <flexpm/kernel/geometry/tessellation.hpp>
#include <flexpm/kernel/topology/assembly_build.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace specimens {

using flexpm::Assembly;
using flexpm::Disc;
using flexpm::Point;

constexpr double thickness = 0.08;  // [m]

struct Specimen {
    flexpm::Tessellation cells;
    std::vector<Disc> discs;
};

// ---- materials -------------------------------------------------------------------------------

/// Grain of the granite: Table 1, Poisson's ratio of Table 3.
inline flexpm::ElasticMaterial granite(flexpm::Plane plane = flexpm::Plane::stress)
{
    flexpm::ElasticMaterial m;
    m.young = 25.8e9;
    m.poisson = 0.23;
    m.density = 2650.0;
    m.plane = plane;
    return m;
}

/// Contact of the granite: stiffness of Table 1, strengths of Table 7.
inline flexpm::ContactMaterial granite_contact()
{
    flexpm::ContactMaterial m;
    m.normal_stiffness = 1.80e14;
    m.shear_ratio = 0.28;
    m.tensile_strength = 8.5e6;
    m.cohesion = 29.75e6;
    m.friction = 0.40;
    m.tensile_fracture_energy = 20.0;
    m.shear_fracture_energy = 800.0;
    return m;
}

/// Contact that no load of a test breaks.
inline flexpm::ContactMaterial strong_contact(
    double normal_stiffness = 1.80e14, double ratio = 0.28)
{
    flexpm::ContactMaterial m = granite_contact();
    m.normal_stiffness = normal_stiffness;
    m.shear_ratio = ratio;
    m.tensile_strength = m.cohesion = 1e14;
    m.tensile_fracture_energy = m.tensile_strength * m.tensile_strength / normal_stiffness;
    m.shear_fracture_energy = m.tensile_fracture_energy / ratio;
    return m;
}

/// Options for one material: thickness of the paper's specimens, refined mesh, three points.
inline flexpm::AssemblyOptions options(const flexpm::ContactMaterial& contact = granite_contact(),
    const flexpm::ElasticMaterial& grain = granite())
{
    flexpm::AssemblyOptions o;
    o.thickness = thickness;
    o.elastic = { grain };
    o.laws = { contact };
    return o;
}

// ---- geometry --------------------------------------------------------------------------------

/// Square grains of side `size`, `nx` along x and `ny` along y, lower left corner in the origin.
/// Sides: 0 bottom, 1 right, 2 top, 3 left. Cell i + nx j is the i-th of row j.
inline Specimen grid(int nx, int ny, double size)
{
    Specimen s;
    flexpm::Tessellation& t = s.cells;
    const auto vertex = [nx](int i, int j) { return i + (nx + 1) * j; };
    for (int j = 0; j <= ny; ++j) {
        for (int i = 0; i <= nx; ++i)
            t.vertices.push_back({ i * size, j * size });
    }
    t.cell_offsets.push_back(0);
    for (int j = 0; j < ny; ++j) {
        for (int i = 0; i < nx; ++i) {
            const int c = i + nx * j;
            s.discs.push_back({ { (i + 0.5) * size, (j + 0.5) * size }, 0.5 * size });
            t.disc_of_cell.push_back(c);
            const int v[] = { vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1),
                vertex(i, j + 1) };
            t.cell_vertices.insert(t.cell_vertices.end(), v, v + 4);
            t.cell_offsets.push_back(static_cast<int>(t.cell_vertices.size()));
            if (i + 1 < nx) t.shared_edges.push_back({ c, c + 1, v[1], v[2] });
            if (j + 1 < ny) t.shared_edges.push_back({ c, c + nx, v[2], v[3] });
            if (j == 0) t.boundary_edges.push_back({ c, v[0], v[1], 0 });
            if (i == nx - 1) t.boundary_edges.push_back({ c, v[1], v[2], 1 });
            if (j == ny - 1) t.boundary_edges.push_back({ c, v[2], v[3], 2 });
            if (i == 0) t.boundary_edges.push_back({ c, v[3], v[0], 3 });
        }
    }
    t.uncollapsed_shared_edges = static_cast<int>(t.shared_edges.size());
    return s;
}

/// One grain; corners counter-clockwise, edge k from corner k is side k. Its centre is the mean of
/// the corners.
inline Specimen polygon(const std::vector<Point>& corners)
{
    Specimen s;
    const int n = static_cast<int>(corners.size());
    Disc disc;
    for (int k = 0; k < n; ++k) {
        disc.centre.x += corners[k].x / n;
        disc.centre.y += corners[k].y / n;
        s.cells.cell_vertices.push_back(k);
        s.cells.boundary_edges.push_back({ 0, k, (k + 1) % n, k });
    }
    disc.radius = std::hypot(corners[0].x - disc.centre.x, corners[0].y - disc.centre.y);
    s.cells.vertices = corners;
    s.cells.cell_offsets = { 0, n };
    s.cells.disc_of_cell = { 0 };
    s.discs = { disc };
    return s;
}

/// An irregular six-sided grain of about 3 mm.
inline Specimen hexagon()
{
    return polygon({ { 0.0, 0.0 }, { 1.6e-3, -0.3e-3 }, { 2.9e-3, 0.8e-3 }, { 2.5e-3, 2.3e-3 },
        { 1.1e-3, 2.8e-3 }, { -0.3e-3, 1.5e-3 } });
}

/// Random grains in a rectangle with its lower left corner in the origin: discs on a square lattice
/// of about `spacing`, moved and sized at random. Sides as in grid(). Edges below 0.1167 of the
/// mean diameter are collapsed, the paper's 0.35 mm for 2-4 mm.
inline Specimen random_grains(double width, double height, double spacing, std::uint64_t seed)
{
    Specimen s;
    flexpm::Random random(seed);
    const int nx = std::max(1, static_cast<int>(std::lround(width / spacing)));
    const int ny = std::max(1, static_cast<int>(std::lround(height / spacing)));
    const double dx = width / nx, dy = height / ny, small = std::min(dx, dy);
    double mean = 0.0;
    for (int j = 0; j < ny; ++j) {
        for (int i = 0; i < nx; ++i) {
            const double x = (i + 0.5 + 0.6 * (random.next() - 0.5)) * dx;
            const double y = (j + 0.5 + 0.6 * (random.next() - 0.5)) * dy;
            s.discs.push_back({ { x, y }, small * (0.38 + 0.2 * random.next()) });
            mean += 2.0 * s.discs.back().radius / (nx * ny);
        }
    }
    flexpm::TessellationOptions o;
    o.short_edge = 0.35 / 3.0 * mean;
    o.allow_hidden = true;
    s.cells = flexpm::tessellate(s.discs,
        flexpm::Outline::polygon(
            { { 0.0, 0.0 }, { width, 0.0 }, { width, height }, { 0.0, height } }),
        o);
    return s;
}

inline Assembly assemble(const Specimen& s, const flexpm::AssemblyOptions& o)
{
    return flexpm::make_assembly(s.cells, s.discs, o);
}

}  // namespace specimens
