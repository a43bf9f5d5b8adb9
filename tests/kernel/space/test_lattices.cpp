// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Cells of lattices, where five and more cells meet in a point: cut out along any
/// direction, and with noise.
#include "support/sphere_samples.hpp"

#include <fstream>
#include <string>

using namespace flexpm_test;

namespace {

/// A lattice of spheres that touch, of diameter 1: three steps, and what each of them holds.
struct Lattice {
    std::string name;
    std::array<Vector, 3> steps;
    std::vector<Vector> places;
    double volume;  ///< of a cell
    int faces;      ///< of a cell
};

const double s2 = std::sqrt(2.0), s3 = std::sqrt(3.0);

const std::vector<Lattice> lattices = {
    { "cubic", { { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } }, { {} }, 1.0, 6 },
    { "hexagonal", { { { 1, 0, 0 }, { 0.5, s3 / 2, 0 }, { 0, 0, 1 } } }, { {} }, s3 / 2, 8 },
    { "hcp", { { { 1, 0, 0 }, { 0.5, s3 / 2, 0 }, { 0, 0, std::sqrt(8.0 / 3.0) } } },
        { {}, { 0.5, s3 / 6, std::sqrt(2.0 / 3.0) } }, 1 / s2, 12 },
    { "fcc", { { { 1 / s2, 1 / s2, 0 }, { 1 / s2, 0, 1 / s2 }, { 0, 1 / s2, 1 / s2 } } }, { {} },
        1 / s2, 12 },
};

constexpr double width = 6.3;

/// Spheres of a turned lattice with their centres inside a cube.
std::vector<Sphere> cut_out(
    const Lattice& lattice, const Rotation& rotation, double noise, Random& random)
{
    std::vector<Sphere> spheres;
    const Vector middle { 0.5 * width, 0.5 * width, 0.5 * width };
    constexpr int far = 12;
    for (int i = -far; i <= far; ++i)
        for (int j = -far; j <= far; ++j)
            for (int k = -far; k <= far; ++k)
                for (Vector place : lattice.places) {
                    const Vector p = place + static_cast<double>(i) * lattice.steps[0]
                        + static_cast<double>(j) * lattice.steps[1]
                        + static_cast<double>(k) * lattice.steps[2];
                    const Vector q = middle + turned(rotation, p);
                    const double x = noise * (random.next() - 0.5),
                                 y = noise * (random.next() - 0.5),
                                 z = noise * (random.next() - 0.5);
                    if (std::min({ q.x, q.y, q.z }) > 0.02
                        && std::max({ q.x, q.y, q.z }) < width - 0.02)
                        spheres.push_back({ q + Vector { x, y, z }, 0.5 });
                }
    return spheres;
}

struct CellFigures {
    int inner = 0;        ///< cells that no wall reaches
    int other_faces = 0;  ///< of them, those with another number of faces
    double volume = 0.0;  ///< largest deviation
};

CellFigures inner_cells(
    const Polyhedra& cells, const std::vector<Sphere>& spheres, const Lattice& lattice)
{
    std::vector<int> faces(cells.cells(), 0);
    for (const PolyhedronFace& face : cells.faces) {
        ++faces[face.cell_a];
        if (face.cell_b >= 0) ++faces[face.cell_b];
    }
    CellFigures found;
    for (int c = 0; c < cells.cells(); ++c) {
        const Vector p = spheres[cells.sphere_of_cell[c]].centre;
        if (std::min({ p.x, p.y, p.z }) < 1.8 || std::max({ p.x, p.y, p.z }) > width - 1.8)
            continue;
        ++found.inner;
        found.other_faces += faces[c] != lattice.faces;
        found.volume = std::max(found.volume, std::abs(cells.volumes[c] / lattice.volume - 1.0));
    }
    return found;
}

/// The largest deviations of a night, by lattice and noise.
class Table {
public:
    void add(const std::string& lattice, double noise, const CellFigures& before,
        const CellFigures& after)
    {
        Row& row = rows_[{ lattice, noise }];
        ++row.rotations;
        row.inner += before.inner;
        row.other_faces += before.other_faces;
        row.before = std::max(row.before, before.volume);
        row.after = std::max(row.after, after.volume);
    }
    void write(const char* file) const
    {
        std::ofstream out(file);
        out << "lattice,noise,rotations,inner_cells,cells_of_other_faces_before,"
               "largest_volume_error_before,largest_volume_error_after\n";
        out.precision(2);
        for (const auto& [of, row] : rows_)
            out << of.first << ',' << of.second << ',' << row.rotations << ',' << row.inner << ','
                << row.other_faces << ',' << row.before << ',' << row.after << '\n';
    }

private:
    struct Row {
        int rotations = 0, inner = 0, other_faces = 0;
        double before = 0.0, after = 0.0;
    };
    std::map<std::pair<std::string, double>, Row> rows_;
};

}  // namespace

TEST_CASE("inner cells of turned lattices are those of the lattice", "[space]")
{
    const int rotations = cases("FLEXPM_ROTATIONS", 5);
    Table table;
    const Solid solid = Solid::box(width, width, width);
    for (const Lattice& lattice : lattices) {
        Random random(7);
        for (int r = 0; r < rotations; ++r) {
            // the first stands straight
            const Rotation rotation = r > 0
                ? random_rotation(random)
                : Rotation { { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } };
            for (double noise : { 0.0, 1e-15, 1e-12, 1e-9, 1e-6 }) {
                CAPTURE(lattice.name, r, noise);
                const auto spheres = cut_out(lattice, rotation, noise, random);
                const double limit = std::max(1e-9, 10.0 * noise);

                const Polyhedra plain = polyhedra(spheres, solid, {});
                require_filled(plain, solid);
                REQUIRE(plain.hidden_spheres.empty());
                const CellFigures before = inner_cells(plain, spheres, lattice);
                REQUIRE(before.inner >= 10);
                REQUIRE(before.volume < limit);
                if (noise <= 1e-12) REQUIRE(before.other_faces == 0);

                const Polyhedra collapsed = polyhedra(spheres, solid, { 0.1, false });
                require_filled(collapsed, solid);
                const CellFigures after = inner_cells(collapsed, spheres, lattice);
                table.add(lattice.name, noise, before, after);
                REQUIRE(after.other_faces == 0);
                // with more noise, vertices on straight edges are taken for corners
                if (noise <= 1e-12) REQUIRE(after.volume < limit);
            }
        }
    }
    if (const char* file = std::getenv("FLEXPM_LATTICES")) table.write(file);
}
