// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  A specimen that is mirrored in x = y, cell by cell, has the mirrored linear solution.
#include "support/catch.hpp"

#include <flexpm/kernel/forces/solid_pressure.hpp>
#include <flexpm/kernel/laboratory/solid_ends.hpp>
#include <flexpm/kernel/space/face_triangles.hpp>
#include <flexpm/kernel/statics/solid_field.hpp>
#include <flexpm/kernel/statics/solid_loading.hpp>

#include "support/solid_states.hpp"

using namespace solid_states;

namespace {

constexpr double bound = 1e-8;  // solutions are in balance to 1e-12

/// A random box with three different sizes.
Packing uneven_box(int grains, std::uint64_t seed)
{
    const double edge = solid_samples::side * std::cbrt(0.3 * grains);
    const auto solid = Solid::box(1.2 * edge, 0.9 * edge, 1.8 * edge);
    return { solid,
        polyhedra(flexpm_test::packed_spheres(solid, grains, seed), solid,
            { 0.1 * solid_samples::side, false }) };
}

/// In the mirror: a place, way or force, and a turn, whose sense changes.
Vector along(Vector v) { return { v.y, v.x, v.z }; }
Vector as_turn(Vector v) { return -along(v); }

/// Wall of a solid whose normal is that one.
int wall_along(const Solid& solid, Vector normal)
{
    const auto found = std::find_if(solid.walls.begin(), solid.walls.end(),
        [&](const Wall& wall) { return dot(wall.normal, normal) > 0.5; });
    return static_cast<int>(found - solid.walls.begin());
}

/// The same cells and vertices in the mirror. Corners run the other way around, to stay
/// counter-clockwise, and begin where the fan of a face does: of fans that are as good the first
/// is taken.
Packing mirrored(const Packing& p)
{
    const Vector size = p.solid.high;
    Packing result { Solid::box(size.y, size.x, size.z), p.cells };
    Polyhedra& cells = result.cells;
    for (auto* places : { &cells.vertices, &cells.centres })
        for (Vector& place : *places)
            place = along(place);
    for (int f = 0; f < static_cast<int>(cells.faces.size()); ++f) {
        PolyhedronFace& face = cells.faces[f];
        if (face.wall >= 0)
            face.wall = wall_along(result.solid, along(p.solid.walls[face.wall].normal));
        std::vector<int> corners = p.cells.corners(f);
        const int fan = face_triangles(p.cells.vertices, corners).front().front();
        std::reverse(corners.begin(), corners.end());
        std::rotate(corners.begin(), std::find(corners.begin(), corners.end(), fan), corners.end());
        std::copy(
            corners.begin(), corners.end(), cells.face_vertices.begin() + cells.face_offsets[f]);
    }
    return result;
}

/// Largest difference of vectors from those in the mirror, over the largest.
template <class Mirror>
double difference(const std::vector<Vector>& plain, const std::vector<Vector>& other, Mirror mirror)
{
    REQUIRE(plain.size() == other.size());
    double worst = 0.0, largest = 0.0;
    for (std::size_t n = 0; n < plain.size(); ++n) {
        worst = std::max(worst, norm(mirror(plain[n]) - other[n]));
        largest = std::max(largest, norm(plain[n]));
    }
    REQUIRE(largest > 0.0);
    return worst / largest;
}

SolidState made(const Packing& p, bool rigid)
{
    return make_solid(p.cells, p.solid, granite(FacePointRule::corners_and_inner, rigid));
}

std::vector<Vector> triples(const std::vector<double>& values)
{
    std::vector<Vector> result;
    for (std::size_t n = 0; n < values.size() / 3; ++n)
        result.push_back(triple_at(values.data(), static_cast<int>(n)));
    return result;
}

/// Keep a solid from sliding and turning: the centre of the first grain stays along x and y, that
/// of the last one along an axis.
void hold_in_place(SolidState& s, int across)
{
    const int first = s.grains.centre(0), last = s.grains.centre(s.grains.count - 1);
    for (int axis : { 0, 1 })
        prescribe(s, { first }, axis, 0.0);
    prescribe(s, { last }, across, 0.0);
}

/// Ways of all nodes under forces on them.
std::vector<double> ways_under(
    const SolidState& s, const LinearSolid& solid, const std::vector<double>& load)
{
    std::vector<std::uint8_t> held;
    const auto hold = [&](int node) {
        for (int axis = 0; axis < 3; ++axis)
            held.push_back(s.grains.prescribed[s.grains.component(node, axis)]);
    };
    if (s.bodies.empty()) {
        for_each_node(s, [&](int grain, int number) { hold(s.grains.node(grain, number)); });
        return solve_free(solid, held, load, std::vector<double>(load.size(), 0.0)).u;
    }
    for (int g = 0; g < s.grains.count; ++g) {
        hold(s.grains.centre(g));
        held.insert(held.end(), 3, 0);  // turns
    }
    const RigidSolid rigid = rigid_solid(s, solid);
    const std::vector<double> none(held.size(), 0.0);
    std::vector<double> on_grains = none;
    rigid.gather(load.data(), on_grains.data());
    return rigid.on_nodes(solve_free(rigid, held, on_grains, none).u.data());
}

struct Pressures {
    double along_x, along_y, on_top;
};

/// What a specimen on a smooth plate does under pressures.
struct Pressed {
    std::vector<Vector> ways;    ///< of nodes
    std::vector<Vector> forces;  ///< on nodes, of grains, contacts and the plate
    double energy;
};

Pressed pressed(SolidState s, const Pressures& p, int across)
{
    hold_end(s, SolidSide::bottom, { false, true });
    hold_in_place(s, across);
    for (int side : { 1, 3 })
        set_pressure(s, side, p.along_x);
    for (int side : { 4, 5 })
        set_pressure(s, side, p.along_y);
    set_pressure(s, static_cast<int>(SolidSide::top), p.on_top);
    find_forces(s);
    std::vector<double> load;
    for_each_node(s, [&](int grain, int number) {
        const Vector f = space_vector(s.grains.force, s.grains.node(grain, number));
        load.insert(load.end(), { f.x, f.y, f.z });
    });
    const LinearSolid solid = linear_solid(s);
    const std::vector<double> u = ways_under(s, solid, load);
    std::vector<double> forces(load.size(), 0.0);
    solid.add(u.data(), forces.data());
    return { triples(u), triples(forces),
        0.5 * std::inner_product(u.begin(), u.end(), load.begin(), 0.0) };
}

}  // namespace

TEST_CASE("A mirrored solid under exchanged pressures has the mirrored solution", "[solids]")
{
    const Packing plain = uneven_box(60, 4), other = mirrored(plain);
    flexpm_test::require_filled(other.cells, other.solid);
    for (const bool rigid : { false, true }) {
        const Pressed one = pressed(made(plain, rigid), { 8e6, 20e6, 12e6 }, 1);
        const Pressed two = pressed(made(other, rigid), { 20e6, 8e6, 12e6 }, 0);
        CAPTURE(rigid);
        CHECK(difference(one.ways, two.ways, along) < bound);
        CHECK(difference(one.forces, two.forces, along) < bound);
        CHECK(two.energy == Approx(one.energy).epsilon(bound));
    }
}

TEST_CASE("A mirrored solid between ends has the mirrored solution", "[solids]")
{
    const Packing plain = uneven_box(60, 4), other = mirrored(plain);
    for (const bool rigid : { false, true }) {
        SolidState one = made(plain, rigid), two = made(other, rigid);
        for (SolidState* s : { &one, &two })
            hold_ends(*s, { true, true });
        hold_in_place(one, 1);
        hold_in_place(two, 0);
        const SolidField found = elastic_field(one), wanted = elastic_field(two);
        CAPTURE(rigid);
        CHECK(difference(found.ways, wanted.ways, along) < bound);
        if (rigid) CHECK(difference(found.turns, wanted.turns, as_turn) < bound);
        CHECK(found.load == Approx(wanted.load).epsilon(bound));
    }
}
