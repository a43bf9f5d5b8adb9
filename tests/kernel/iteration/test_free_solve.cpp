// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Conjugate gradients of structures that are free to move.
#include "support/catch.hpp"

#include <flexpm/kernel/iteration/free_solve.hpp>

#include <numeric>

using namespace flexpm;

namespace {

/// Nodes in a row between springs that resist along all axes alike.
struct Chain : LinearForces {
    std::vector<double> springs;  ///< from each node to the next [N/m]
    bool moves = false;           ///< motions of the whole are looked for

    explicit Chain(std::vector<double> of) : springs(std::move(of)) { }
    int nodes() const { return static_cast<int>(springs.size()) + 1; }
    void add(const double* u, double* forces) const override
    {
        for (int k = 0; k + 1 < nodes(); ++k) {
            for (int axis = 0; axis < 3; ++axis) {
                const int i = 3 * k + axis;
                const double f = springs[k] * (u[i + 3] - u[i]);
                forces[i] -= f;
                forces[i + 3] += f;
            }
        }
    }
    DiagonalBlocks diagonal_blocks() const override
    {
        std::vector<int> alone(nodes());
        std::iota(alone.begin(), alone.end(), 0);
        DiagonalBlocks blocks(alone);
        for (int k = 0; k < nodes(); ++k) {
            const double left = k > 0 ? springs[k - 1] : 0.0;
            const double sum = left + (k + 1 < nodes() ? springs[k] : 0.0);
            blocks.add(k, k, 1.0, { { sum, 0.0, 0.0 }, { 0.0, sum, 0.0 }, { 0.0, 0.0, sum } });
        }
        return blocks;
    }
    RigidPart rigid_part(int) const override { return { moves ? 1.0 : 0.0, 0.0, {} }; }
};

}  // namespace

TEST_CASE("Parts that hang together with nothing held keep the motion of the guess", "[elastic]")
{
    // the first two nodes are one part, the others another one; only the second part is held
    const Chain chain({ 2.0, 0.0, 3.0, 5.0 });
    std::vector<std::uint8_t> held(15, 0);
    for (int axis = 0; axis < 3; ++axis)
        held[12 + axis] = 1;
    std::vector<double> load(15, 0.0), guess(15, 0.0);
    load[0] = -4.0;
    load[3] = 4.0;
    load[6] = 15.0;
    guess[0] = guess[3] = 7.0;
    const FreeSolution found = solve_free(chain, held, load, guess);
    CHECK(found.residual <= 1e-10);
    const double expected[] = { 6.0, 8.0, 15.0 / 3.0 + 15.0 / 5.0, 15.0 / 5.0, 0.0 };
    for (int k = 0; k < 5; ++k) {
        CHECK(found.u[3 * k] == Approx(expected[k]).margin(1e-9));
        CHECK(found.u[3 * k + 1] == Approx(0.0).margin(1e-9));
    }
}

TEST_CASE("A motion of the whole that no force opposes keeps that of the guess", "[elastic]")
{
    Chain chain({ 2.0, 3.0, 5.0 });
    chain.moves = true;
    std::vector<std::uint8_t> held(12, 0);
    for (int k = 0; k < 4; ++k)
        held[3 * k + 2] = 1;  // there is a motion along x and one along y
    held[1] = 1;              // none along y
    std::vector<double> load(12, 0.0), guess(12, 0.0);
    load[0] = -6.0;
    load[9] = 6.0;
    load[10] = 15.0;
    for (int k = 0; k < 4; ++k)
        guess[3 * k] = k == 0 ? 4.0 : 8.0;
    const FreeSolution found = solve_free(chain, held, load, guess);
    const double along_x[] = { -3.0, 0.0, 2.0, 3.2 }, along_y[] = { 0.0, 7.5, 12.5, 15.5 };
    for (int k = 0; k < 4; ++k) {
        CHECK(found.u[3 * k] == Approx(along_x[k] - 0.55 + 7.0));
        CHECK(found.u[3 * k + 1] == Approx(along_y[k]).margin(1e-9));
        CHECK(found.u[3 * k + 2] == 0.0);
    }
}

TEST_CASE("A load that nothing bears is told in one line", "[elastic]")
{
    std::vector<double> load(6, 0.0);
    load[0] = 1.0;
    const std::vector<double> guess(6, 0.0);
    const auto solve = [&](double spring) {
        solve_free(Chain({ spring }), std::vector<std::uint8_t>(6, 0), load, guess);
    };
    for (const double spring : { 0.0, 1.0 })
        CHECK_THROWS_WITH(solve(spring),
            Catch::Contains("elastic solution: residual = ") && Catch::Contains("must be below"));
}
