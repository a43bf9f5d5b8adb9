// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Smooth motions of a solid, which precondition its equilibrium.
#include "support/catch.hpp"

#include <flexpm/kernel/iteration/coarse_grid.hpp>
#include <flexpm/kernel/statics/solid_field.hpp>

#include "support/solid_states.hpp"

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
};

}  // namespace

TEST_CASE("A coarse grid stretches a bar by its stiffness, and leaves what is held", "[solids]")
{
    const Block block;
    const PlaneStiffness c { 30e9, 10e9, 10e9 };
    CoarseGrid grid(block.places);
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
    CoarseGrid grid(block.places);
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
    CoarseGrid empty(none);
    empty.factorize();
    empty.add_motion({}, nullptr, nullptr);
}

TEST_CASE(
    "A solid eight times as long takes less than twice the iterations", "[solids][many_steps]")
{
    const auto iterations = [&](int long_by) {
        const Packing p { Solid::box(4 * side, 4 * side, long_by * side), brick(4, 4, long_by) };
        const LinearSolid solid = linear_solid(make_solid(p.cells, p.solid, granite()));
        std::vector<std::uint8_t> held;
        std::vector<double> load;
        for (const Vector& place : solid.places) {
            held.insert(held.end(), 3, place.z < 1e-9 ? 1 : 0);
            load.insert(load.end(), { place.z < 1e-9 ? 0.0 : 1.0, 0.0, 0.0 });
        }
        return solve_free(solid, held, load, std::vector<double>(load.size(), 0.0)).iterations;
    };
    // pushed sideways; 86 and 143, and 194 and 1738 without a coarse grid
    const int few = iterations(8), many = iterations(64);
    CHECK(many < 2 * few);
}
