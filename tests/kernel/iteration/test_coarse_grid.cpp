// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Smooth motions of a solid, which precondition its equilibrium.
#include "support/catch.hpp"

#include <flexpm/kernel/iteration/coarse_grid.hpp>
#include <flexpm/kernel/statics/solid_field.hpp>

#include "support/solid_states.hpp"

#include <random>

using namespace solid_states;

using solid_samples::brick;
using solid_samples::side;

namespace {

/// Nodes in the middles of small cubes in a box, and at its corners, where no volume lies.
struct Block {
    static constexpr double edge = 0.01, height = 0.04;
    static constexpr int across = 12;
    std::vector<Vector> places;

    Block()
    {
        for (int k = 0; k < 4 * across; ++k)
            for (int j = 0; j < across; ++j)
                for (int i = 0; i < across; ++i)
                    places.push_back((edge / across) * Vector { i + 0.5, j + 0.5, k + 0.5 });
        places.push_back({ 0.0, 0.0, 0.0 });
        places.push_back({ edge, edge, height });
    }
    std::size_t inner() const { return places.size() - 2; }
    CoarseGrid grid() const
    {
        const std::vector<Vector> grains(places.size() / 25);
        return { places, grains, CoarseGrid::Moves::nodes };
    }
};

}  // namespace

TEST_CASE("A coarse grid stretches a bar by its stiffness, and leaves what is held", "[solids]")
{
    const Block block;
    const PlaneStiffness c { 30e9, 10e9, 10e9 };
    CoarseGrid grid = block.grid();
    const double volume =
        Block::edge * Block::edge * Block::height / static_cast<double>(block.inner());
    for (std::size_t n = 0; n < block.inner(); ++n)
        grid.add_volume(block.places[n], volume, c);
    // the bottom is held, and all of it sideways: uniaxial strain
    constexpr double firm = 1e9;
    std::vector<double> forces(3 * block.places.size(), 0.0), motion(forces.size(), 0.0);
    std::vector<std::uint8_t> held(forces.size(), 0);
    const double load = 1000.0;
    for (std::size_t n = 0; n < block.inner(); ++n) {
        const Vector at = block.places[n];
        const double up = at.z < Block::edge / Block::across ? firm : 0.0;
        grid.add_spring(at, { { firm, 0.0, 0.0 }, { 0.0, firm, 0.0 }, { 0.0, 0.0, up } });
        held[3 * n] = held[3 * n + 1] = 1;
        if (at.z > Block::height - Block::edge / Block::across)
            forces[3 * n + 2] = load / (Block::across * Block::across);
    }
    grid.factorize();
    grid.add_motion(held, forces.data(), motion.data());
    const double strain = load / (Block::edge * Block::edge * c.normal);
    const auto way = [&](int layer) {
        double sum = 0.0;
        for (int n = 0; n < Block::across * Block::across; ++n)
            sum += motion[3 * (layer * Block::across * Block::across + n) + 2];
        return sum / (Block::across * Block::across);
    };
    const double length = 24.0 * Block::edge / Block::across;
    CHECK((way(36) - way(12)) / length == Approx(strain).epsilon(0.02));
    for (std::size_t i = 0; i < motion.size(); ++i)
        if (held[i]) CHECK(motion[i] == 0.0);
}

TEST_CASE("A grid that nothing holds is as good, and one without nodes moves nothing", "[solids]")
{
    const Block block;
    CoarseGrid grid = block.grid();
    for (std::size_t n = 0; n < block.inner(); ++n)
        grid.add_volume(block.places[n], 1e-9, { 30e9, 10e9, 10e9 });
    grid.factorize();
    // forces in balance pull it apart, and move it as a whole by little
    std::vector<double> forces(3 * block.places.size(), 0.0), motion(forces.size(), 0.0);
    forces[2] = -1.0;
    forces[3 * block.inner() - 1] = 1.0;
    grid.add_motion(std::vector<std::uint8_t>(forces.size(), 0), forces.data(), motion.data());
    CHECK(motion[2] < 0.0);
    CHECK(motion[3 * block.inner() - 1] == Approx(-motion[2]).epsilon(0.1));
    const std::vector<Vector> none;
    CoarseGrid empty(none, none, CoarseGrid::Moves::nodes);
    empty.factorize();
    empty.add_motion({}, nullptr, nullptr);
}

TEST_CASE("A coarse grid of rigid grains opens contacts by their stiffness", "[solids]")
{
    // cubes, sideways held, pulled from a bottom that holds the first layer
    constexpr int across = 6, layers = 24;
    constexpr double edge = 1e-3, k = 2e6, load = 1000.0;
    std::vector<Vector> centres,
        nodes { { 0.0, 0.0, 0.0 }, { across * edge, across * edge, layers * edge } };
    for (int z = 0; z < layers; ++z)
        for (int y = 0; y < across; ++y)
            for (int x = 0; x < across; ++x)
                centres.push_back(edge * Vector { x + 0.5, y + 0.5, z + 0.5 });
    CoarseGrid grid(nodes, centres, CoarseGrid::Moves::grains);
    constexpr double firm = 1e3 * k;
    std::vector<GridMotion> loads(centres.size());
    for (int g = 0; g < static_cast<int>(centres.size()); ++g) {
        const int layer = g / (across * across);
        const double up = layer == 0 ? firm : 0.0;
        grid.add_spring(g, Vector {},
            SpaceGradient { { firm, 0.0, 0.0 }, { 0.0, firm, 0.0 }, { 0.0, 0.0, up } });
        if (layer + 1 < layers) {
            const Vector above { 0.0, 0.0, edge };
            grid.add_contact(centres[g] + 0.5 * above, above,
                { { 0.3 * k, 0.0, 0.0 }, { 0.0, 0.3 * k, 0.0 }, { 0.0, 0.0, k } });
        } else {
            loads[g].way = { 0.0, 0.0, load / (across * across) };
        }
    }
    grid.factorize();
    const std::vector<GridMotion> found = grid.motions(loads);
    const auto way = [&](int layer) {
        double sum = 0.0;
        for (int g = 0; g < across * across; ++g)
            sum += found[layer * across * across + g].way.z;
        return sum / (across * across);
    };
    const double opening = load / (across * across) / k;
    CHECK((way(18) - way(6)) / 12.0 == Approx(opening).epsilon(0.03));
    for (const GridMotion& m : found)
        CHECK(norm(m.turn) < 0.1 * opening / edge);
}

TEST_CASE("Motions of grains on a coarse grid do as much work with exchanged loads", "[solids]")
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    const auto drawn = [&] { return Vector { any(random), any(random), any(random) }; };
    std::vector<Vector> centres;
    for (int g = 0; g < 60; ++g)
        centres.push_back(1e-3 * (drawn() + Vector { 1.0, 1.0, 1.0 }));
    CoarseGrid grid(centres, centres, CoarseGrid::Moves::grains);
    for (int g = 0; g < 60; ++g) {
        grid.add_contact(
            centres[g], 1e-3 * drawn(), { { 2e6, 0, 0 }, { 0, 2e6, 0 }, { 0, 0, 5e6 } });
        grid.add_spring(g, 1e-4 * drawn(), { { 1e5, 0, 0 }, { 0, 1e5, 0 }, { 0, 0, 1e5 } });
    }
    grid.factorize();
    const auto loads = [&] {
        std::vector<GridMotion> some;
        for (int g = 0; g < 60; ++g)
            some.push_back({ drawn(), 1e-3 * drawn() });
        return some;
    };
    const auto work = [&](const std::vector<GridMotion>& of, const std::vector<GridMotion>& in) {
        const std::vector<GridMotion> motions = grid.motions(of);
        double sum = 0.0;
        for (std::size_t g = 0; g < in.size(); ++g)
            sum += dot(in[g].way, motions[g].way) + dot(in[g].turn, motions[g].turn);
        return sum;
    };
    const auto one = loads(), two = loads();
    CHECK(work(one, two) == Approx(work(two, one)).epsilon(1e-9));
    CHECK(work(one, one) > 0.0);
    CHECK(work(two, two) > 0.0);
}

namespace {

/// Iterations of a column that is held below and pushed sideways, of grains so many along each edge.
int iterations_of(int across, int long_by, bool rigid, double compliance)
{
    const Packing p { Solid::box(across * side, across * side, long_by * side),
        brick(across, across, long_by) };
    SolidInput input = granite(FacePointRule::corners_and_inner, rigid);
    input.contacts = { specimens::strong_contact(1.8e14 / compliance, 0.28) };
    const SolidState s = make_solid(p.cells, p.solid, input);
    const LinearSolid solid = linear_solid(s);
    std::vector<std::uint8_t> held;
    std::vector<double> load;
    const auto add = [&](Vector place, bool turns) {
        const bool low = place.z < (rigid ? side : 1e-9);
        held.insert(held.end(), 3, low ? 1 : 0);
        load.insert(load.end(), { low ? 0.0 : 1.0, 0.0, 0.0 });
        if (!turns) return;
        held.insert(held.end(), 3, low ? 1 : 0);
        load.insert(load.end(), 3, 0.0);
    };
    const auto solved = [&](const LinearForces& forces) {
        return solve_free(forces, held, load, std::vector<double>(load.size(), 0.0)).iterations;
    };
    if (!rigid) {
        for (const Vector& place : solid.places)
            add(place, false);
        return solved(solid);
    }
    const RigidSolid grains = rigid_solid(s, solid);
    for (const Vector& centre : grains.centres)
        add(centre, true);
    return solved(grains);
}

}  // namespace

TEST_CASE("A longer solid takes hardly more iterations", "[solids][many_steps]")
{
    for (const bool rigid : { false, true }) {
        const int few = iterations_of(4, 8, rigid, 1.0), many = iterations_of(4, 64, rigid, 1.0);
        CAPTURE(rigid, few, many);
        CHECK(many < 2 * few);
    }
}

TEST_CASE("Compliant contacts take hardly more iterations", "[solids][many_steps]")
{
    for (const bool rigid : { false, true }) {
        const int few = iterations_of(6, 12, rigid, 1.0), many = iterations_of(6, 12, rigid, 100.0);
        CAPTURE(rigid, few, many);
        CHECK(many < 1.5 * few);
    }
}
