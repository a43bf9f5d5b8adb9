// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Joints across a packing: their faces add up to their section, no volume is lost, and
/// discs cut what they should.
#include "space/closed_cells.hpp"

#include <flexpm/kernel/space/fan_meshes.hpp>
#include <flexpm/kernel/space/power_cells.hpp>
#include <flexpm/kernel/space/wall_cuts.hpp>

#include <limits>

using namespace flexpm_test;

namespace {

constexpr double side = 3e-3;  ///< of a grain, roughly [m]
const Solid block = Solid::box(6.0 * side, 5.0 * side, 7.0 * side);
const Solid core = Solid::cylinder(6.0 * side, 8.0 * side, side);

double sum_of(const std::vector<double>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0);
}

Vector random_direction(Random& random) { return turned(random_rotation(random), { 0, 0, 1 }); }

Vector random_place(Random& random, const Solid& solid)
{
    const Vector size = solid.high - solid.low;
    return solid.low
        + Vector { random.next() * size.x, random.next() * size.y, random.next() * size.z };
}

JointPlane plane_through(Vector point, Vector normal) { return { normal, dot(normal, point) }; }

/// Regular polygon of 16 corners about a point.
JointPlane disc_about(Vector centre, Vector normal, double radius)
{
    JointPlane disc = plane_through(centre, normal);
    Vector u = cross(normal, std::fabs(normal.x) < 0.5 ? Vector { 1, 0, 0 } : Vector { 0, 1, 0 });
    u = (1.0 / norm(u)) * u;
    const Vector v = cross(normal, u);
    for (int k = 0; k < 16; ++k) {
        const double angle = pi * k / 8.0;
        disc.corners.push_back(
            centre + (radius * std::cos(angle)) * u + (radius * std::sin(angle)) * v);
    }
    return disc;
}

/// Cells of a packing before short edges are collapsed.
CellComplex cells_in(const Solid& solid, int count, std::uint64_t seed)
{
    CellComplex complex = power_cells(packed_spheres(solid, count, seed), solid);
    cut_by_walls(complex, solid, zero_edge * side);
    merge_close_vertices(complex, zero_edge * side);
    return complex;
}

Polyhedra jointed(const Solid& solid, int count, std::uint64_t seed,
    const std::vector<JointPlane>& joints, double short_edge = 0.1 * side)
{
    PolyhedraOptions options { short_edge, false };
    options.joints = joints;
    return polyhedra(packed_spheres(solid, count, seed), solid, options);
}

}  // namespace

TEST_CASE("Faces of a plane add up to its section where no piece is too small", "[space]")
{
    Random random(7);
    for (const Solid& solid : { block, core }) {
        for (int k = 0; k < 8; ++k) {
            CellComplex complex = cells_in(solid, 200, 1 + k);
            const JointPlane plane =
                plane_through(random_place(random, solid), random_direction(random));
            PlaneCut cut { plane.normal, plane.offset };
            cut.wall = static_cast<int>(solid.walls.size());
            CellCutter cutter(complex, { zero_edge * side, 0.0, 0.0, 1.0 });
            const CutAreas found = cutter.cut_by_plane(cut);
            CHECK(found.cut == Approx(area_within(plane, solid)).epsilon(1e-9));
            CHECK(found.bend <= zero_edge * side);
            CHECK(found.bridged + found.beyond + found.taken == 0.0);
            CHECK(std::abs(sum_of(cell_volumes(complex)) / solid.volume - 1.0) < 1e-12);
            CHECK(complex.cells > 200);
        }
    }
}

TEST_CASE("A plane goes round pieces that are too small", "[space]")
{
    Random random(8);
    for (int k = 0; k < 6; ++k) {
        const Solid& solid = k % 2 == 0 ? block : core;
        const JointPlane plane =
            plane_through(0.5 * (solid.low + solid.high), random_direction(random));
        const Polyhedra whole = jointed(solid, 200, 20 + k, { plane }, 0.0);
        const double least = *std::min_element(whole.volumes.begin(), whole.volumes.end());
        CHECK(least > 0.0199 * solid.volume / 200);
        const JointOutcome& told = whole.joint_cuts.at(0);
        CHECK(told.areas.cut == Approx(told.within).epsilon(0.05));
        CHECK(told.areas.bend < 0.5 * side);
        CHECK(told.areas.bend > 0.0);
        CHECK(told.areas.detour > 0.0);
        const Polyhedra cells = jointed(solid, 200, 20 + k, { plane });
        CHECK(std::abs(sum_of(cells.volumes) / solid.volume - 1.0) < 1e-12);
        CHECK(loose_edges(cells) == 0);
        CHECK_NOTHROW(fan_meshes(cells));
        // sections lie in the plane, and stay there when edges are collapsed
        int in_plane = 0, faces = 0;
        for (int f = 0; f < cells.contacts; ++f) {
            if (cells.joints[f] != 0) continue;
            ++faces;
            double off = 0.0;
            for (const Vector& p : polygon(cells, f))
                off = std::max(off, std::fabs(dot(plane.normal, p) - plane.offset));
            in_plane += off < 1e-12;
        }
        CHECK(in_plane > 0.3 * faces);
    }
}

TEST_CASE("A second cut of the same plane finds its faces taken", "[space]")
{
    const JointPlane plane = plane_through({ 3.1 * side, 2.0 * side, 3.3 * side }, { 0, 0.6, 0.8 });
    const Polyhedra once = jointed(block, 200, 3, { plane });
    const Polyhedra twice = jointed(block, 200, 3, { plane, plane });
    CHECK(once.cells() == twice.cells());
    CHECK(once.joints == twice.joints);
    CHECK(twice.joint_cuts.at(1).areas.cut == 0.0);
    CHECK(twice.joint_cuts.at(1).areas.taken
        == Approx(once.joint_cuts.at(0).areas.cut).epsilon(1e-12));
}

TEST_CASE("Planes that cross cut pieces of each other, also nearly coplanar ones", "[space]")
{
    const Vector middle = 0.5 * (block.low + block.high);
    std::vector<JointPlane> planes = { plane_through(middle, { 0, 0, 1 }),
        plane_through(middle, { 0, 0.6, 0.8 }), plane_through(middle, { 1, 0, 0 }) };
    for (const double turn : { 1e-12, 1e-9, 1e-6, 1e-3, 0.1 }) {
        planes.push_back(plane_through(middle, { std::sin(turn), 0, std::cos(turn) }));
        planes.push_back(plane_through(middle + Vector { 0, 0, turn * side }, { 0, 0, 1 }));
    }
    const Polyhedra cells = jointed(block, 200, 4, planes);
    CHECK(std::abs(sum_of(cells.volumes) / block.volume - 1.0) < 1e-12);
    CHECK(loose_edges(cells) == 0);
    CHECK_NOTHROW(fan_meshes(cells));
}

TEST_CASE("Discs cut their area in the mean, and many of them lose no volume", "[space]")
{
    Random random(9);
    double cut = 0.0, asked = 0.0;
    const Vector middle = 0.5 * (block.low + block.high);
    for (int k = 0; k < 40; ++k) {
        const JointPlane disc = disc_about(
            middle + 0.5 * side * random_direction(random), random_direction(random), 1.5 * side);
        const JointOutcome told = jointed(block, 200, 5, { disc }, 0.0).joint_cuts.at(0);
        cut += told.areas.cut;
        asked += told.within;
    }
    CHECK(cut / asked == Approx(0.97).margin(0.05));

    std::vector<JointPlane> many;
    for (int k = 0; k < cases("FLEXPM_DISCS", 200); ++k)
        many.push_back(disc_about(random_place(random, block), random_direction(random),
            (0.7 + 2.0 * random.next()) * side));
    const Polyhedra cells = jointed(block, 400, 6, many);
    CHECK(std::abs(sum_of(cells.volumes) / block.volume - 1.0) < 1e-12);
    CHECK(loose_edges(cells) == 0);
    CHECK_NOTHROW(fan_meshes(cells));
    CHECK(cells.cells() > 600);
    // once more: the same bits
    const Polyhedra again = jointed(block, 400, 6, many);
    CHECK(again.joints == cells.joints);
    CHECK(again.volumes == cells.volumes);
}

TEST_CASE("A plane on a wall has no area inside the specimen", "[space]")
{
    for (const Solid& solid : { block, core }) {
        const double top = solid.high.z, off = 1e-12 * top;
        for (const double z : { 0.0, off, -off, top, top - off, top + off })
            for (const double up : { 1.0, -1.0 })
                CHECK(area_within(plane_through({ 0, 0, z }, { 0, 0, up }), solid) == 0.0);
        const double section = solid.volume / top;
        for (const double z : { 1e-6 * top, (1.0 - 1e-6) * top })
            CHECK(area_within(plane_through({ 0, 0, z }, { 0, 0, 1 }), solid)
                == Approx(section).epsilon(1e-9));
    }
    CHECK(area_within(disc_about(block.high, { 0, 0, 1 }, side), block) == 0.0);
}

TEST_CASE("A cell without a closed section is passed only near the region", "[space]")
{
    // a U along y, both arms of which the plane crosses, and a cube on one arm
    const std::vector<Vector> u = { { 0, 0, 0 }, { 3, 0, 0 }, { 3, 0, 2 }, { 2, 0, 2 }, { 2, 0, 1 },
        { 1, 0, 1 }, { 1, 0, 2 }, { 0, 0, 2 } };
    CellComplex both;
    both.cells = 2;
    for (const double y : { 0.0, 1.0 })
        for (const Vector& p : u)
            both.vertices.push_back({ p.x, y, p.z });
    for (const double y : { 0.0, 1.0 })
        for (const double x : { 0.0, 1.0 })
            both.vertices.push_back({ x, y, 3.0 });
    both.walls.resize(both.vertices.size());
    both.faces.push_back({ 0, -1, 0, { 0, 1, 2, 3, 4, 5, 6, 7 } });
    both.faces.push_back({ 0, -1, 0, { 15, 14, 13, 12, 11, 10, 9, 8 } });
    for (int k = 0; k < 8; ++k) {
        const int next = (k + 1) % 8, other = k == 6 ? 1 : -1;
        both.faces.push_back({ 0, other, other < 0 ? 0 : -1, { next, k, k + 8, next + 8 } });
    }
    both.faces.push_back({ 1, -1, 0, { 7, 6, 17, 16 } });
    both.faces.push_back({ 1, -1, 0, { 14, 15, 18, 19 } });
    both.faces.push_back({ 1, -1, 0, { 15, 7, 16, 18 } });
    both.faces.push_back({ 1, -1, 0, { 6, 14, 19, 17 } });
    both.faces.push_back({ 1, -1, 0, { 16, 17, 19, 18 } });
    REQUIRE(cell_volumes(both)[0] == Approx(5.0));
    REQUIRE(cell_volumes(both)[1] == Approx(1.0));
    const auto cut_where = [&](const std::vector<HalfSpace>& region) {
        CellComplex complex = both;
        PlaneCut cut { { 0, 0, 1 }, 1.8, region };
        cut.wall = 1;
        return CellCutter(complex, { 1e-9, 0.0, 0.0, 1.0 }).cut_by_plane(cut).cut;
    };
    CHECK(cut_where({}) == Approx(1.0));
    CHECK(cut_where({ { { -1, 0, 0 }, -1.0 } }) == Approx(1.0));  // x > 1
    CHECK(cut_where({ { { -1, 0, 0 }, -5.0 } }) == 0.0);          // x > 5
}

TEST_CASE("Joints that are no planes are refused", "[space]")
{
    const JointPlane good = disc_about({ side, side, side }, { 0, 0, 1 }, side);
    const auto refused = [](JointPlane joint, const char* why) {
        CHECK_THROWS_WITH(jointed(block, 200, 1, { joint }), Catch::Contains(why));
    };
    JointPlane bad = good;
    bad.normal = { 0, 0, 2 };
    refused(bad, "must have the length 1");
    bad = good;
    bad.offset = std::numeric_limits<double>::quiet_NaN();
    refused(bad, "finite");
    bad = good;
    bad.corners.resize(2);
    refused(bad, "must be three or more");
    bad = good;
    bad.corners[0].z += 1e-3 * side;
    refused(bad, "distance of a corner from its plane");
    bad = good;
    bad.corners[0] = { side, side, side };
    refused(bad, "must be convex");
    bad.corners = { { 0, 0, side }, { side, 0, side }, { 2.0 * side, 0, side } };
    refused(bad, "area = ");
    bad.corners[1].x = std::numeric_limits<double>::infinity();
    refused(bad, "must be finite");
    // the sense of rotation does not matter, nor corners on a straight edge and twice in one place
    JointPlane square = plane_through({ 0, 0, 3.0 * side }, { 0, 0, 1 });
    for (const auto& [x, y] : { std::pair(1.0, 1.0), { 1.0, 2.0 }, { 1.0, 4.0 }, { 1.0, 4.0 },
             { 4.0, 4.0 }, { 4.0, 1.0 } })
        square.corners.push_back({ x * side, y * side, 3.0 * side });
    CHECK(jointed(block, 200, 1, { square }).joint_cuts.at(0).within == Approx(9.0 * side * side));
}
