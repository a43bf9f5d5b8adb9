// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Linear equilibrium: rigid motions, free parts, stepping, bad input.
/// SI units.
#include "support/dense.hpp"
#include "support/specimens.hpp"
#include "support/statics.hpp"

#include <flexpm/kernel/forces/sides.hpp>
#include <flexpm/kernel/statics/elastic_constants.hpp>
#include <flexpm/kernel/statics/static_solve.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/step/step.hpp>

#include "support/catch.hpp"

#include <cmath>
#include <cstdio>
#include <string>

using namespace flexpm;
using namespace statics;

namespace {

/// Two grains side by side that nothing bonds.
Assembly two_loose_grains()
{
    auto s = specimens::grid(2, 1, 2e-3);
    s.cells.shared_edges.clear();
    return specimens::assemble(s, specimens::options());
}

/// Largest difference over largest value of `b`.
double difference(const Array<double>& a, const Array<double>& b)
{
    double error = 0.0, size = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        error = std::max(error, std::fabs(a[i] - b[i]));
        size = std::max(size, std::fabs(b[i]));
    }
    return error / size;
}

}  // namespace

TEST_CASE("the stiffness is symmetric and does not resist rigid motions", "[elastic]")
{
    const Assembly a =
        specimens::assemble(specimens::random_grains(0.012, 0.012, 3e-3, 3), specimens::options());
    const Eigen::MatrixXd k = dense::stiffness(a);
    const double size = k.cwiseAbs().maxCoeff();
    CHECK((k - k.transpose()).cwiseAbs().maxCoeff() < 1e-14 * size);
    const std::vector<int> index = dense::components(a);
    Eigen::MatrixXd rigid = Eigen::MatrixXd::Zero(k.rows(), 3);
    for (std::size_t i = 0; i < index.size(); i += 2) {
        const Point p = a.grains.point_at(index[i]);
        const Eigen::Index r = static_cast<Eigen::Index>(i);
        rigid(r, 0) = rigid(r + 1, 1) = 0.012;
        rigid(r, 2) = -p.y;
        rigid(r + 1, 2) = p.x;
    }
    CHECK((k * rigid).cwiseAbs().maxCoeff() < 1e-14 * size * 0.012);
    const Eigen::VectorXd values =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k, Eigen::EigenvaluesOnly).eigenvalues();
    CHECK(values[2] < 1e-13 * size);
    CHECK(values[3] > 1e-6 * size);
}

TEST_CASE("forces balance: loads, reactions, nothing elsewhere", "[elastic]")
{
    const Assembly a = random_assembly();
    const auto prescribed = hold_sides(a, -1e-5);
    Array<double> loads(a.grains.displacement.size(), 0.0);
    const int loaded = side_nodes(a, 1).front();
    loads[loaded] = 250.0;
    const StaticSolution s = solve_static(a, prescribed, &loads);
    std::vector<char> held(a.grains.displacement.size(), 0);
    for (const Prescribed& p : prescribed)
        held[p.index] = 1;
    double reaction_y = 0.0, sum_y = 0.0, rest = 0.0;
    for (std::size_t i = 0; i < s.force.size(); ++i) {
        const bool along_y = i % (2 * lanes) >= lanes;
        if (along_y) sum_y += s.force[i];
        if (along_y && held[i]) reaction_y += std::fabs(s.force[i]);
        if (!held[i]) rest = std::max(rest, std::fabs(s.force[i] + loads[i]));
    }
    CHECK(reaction_y > 1e4);
    CHECK(std::fabs(sum_y) < 1e-9 * reaction_y);
    CHECK(rest < 1e-9 * reaction_y);
    CHECK(s.force[prescribed[0].index] == Approx(250.0).epsilon(1e-7));
    for (const Prescribed& p : prescribed)
        CHECK(s.displacement[p.index] == p.value);
}

TEST_CASE("stepping settles where the linear solve says", "[elastic]")
{
    const auto mesh = GENERATE(MeshKind::fan, MeshKind::refined);
    const int points = GENERATE(1, 2, 3);
    AssemblyOptions o = specimens::options(specimens::strong_contact());
    o.mesh = mesh;
    o.points = points;
    Assembly a = specimens::assemble(specimens::random_grains(0.012, 0.015, 3e-3, 5), o);
    const double moved = -0.015 * 1e-9;  // so small that the linear answer is the answer
    const StaticSolution s = solve_static(a, hold_sides(a, moved));

    scale_masses(a, 0.7);
    const std::vector<int> bottom = side_nodes(a, 0), top = side_nodes(a, 2);
    prescribe(a, bottom, 1, 0.0);
    prescribe(a, { bottom.front() }, 0, 0.0);
    prescribe(a, top, 1, moved / 500.0);
    for (int n = 0; n < 500; ++n)
        step(a, StepOptions());
    prescribe(a, top, 1, 0.0);
    for (int n = 0; n < 6000; ++n)
        step(a, StepOptions());
    CHECK(difference(a.grains.displacement, s.displacement) < 1e-7);
    CHECK(difference(a.grains.force, s.force) < 1e-7);
}

TEST_CASE("a part that moves freely is named", "[elastic]")
{
    const Assembly a = two_loose_grains();
    CHECK_THROWS_AS(solve_static(a, {}), std::runtime_error);
    std::vector<Prescribed> left;
    for (int k = 0; k < a.grains.nodes_of(0); ++k) {
        left.push_back({ a.grains.node(0, k), 0.0 });
        left.push_back({ component(a.grains.node(0, k), 1), 0.0 });
    }
    std::string message;
    try {
        solve_static(a, left);
    } catch (const std::runtime_error& e) {
        message = e.what();
    }
    REQUIRE_THAT(message, Catch::Contains("hold nodes") && !Catch::Contains("\n"));
    double x = 0.0;
    const char* form = "solve_static: pivot / stiffness = %*g at x, y = %lg";
    REQUIRE(std::sscanf(message.c_str(), form, &x) == 1);
    CHECK(x >= 2e-3);  // the right grain is the free one
    // held against translation only: it still spins
    const int corner = a.grains.node(1, 0);
    left.push_back({ corner, 0.0 });
    left.push_back({ component(corner, 1), 0.0 });
    CHECK_THROWS_AS(solve_static(a, left), std::runtime_error);
}

TEST_CASE("a free specimen is told from a stiff one", "[elastic]")
{
    for (const std::uint64_t seed : { 1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u }) {
        const auto s = specimens::random_grains(0.02, 0.02, 3e-3, seed);
        // contacts ten thousand times as stiff as the granite's still solve
        const Assembly a =
            specimens::assemble(s, specimens::options(specimens::strong_contact(1.80e18)));
        CHECK(elastic_constants(a).youngs_modulus == Approx(25.8e9).epsilon(1e-4));
        CHECK_THROWS_AS(solve_static(a, {}), std::runtime_error);
        CHECK_THROWS_AS(
            solve_static(
                a, { { a.grains.node(0, 0), 0.0 }, { component(a.grains.node(0, 0), 1), 0.0 } }),
            std::runtime_error);
    }
}

TEST_CASE("wrong loads and supports are refused in one line", "[elastic]")
{
    const Assembly a = specimens::assemble(specimens::hexagon(), specimens::options());
    const int n = a.grains.node(0, 0);
    const int size = static_cast<int>(a.grains.displacement.size());
    const auto refused = [&](const std::vector<Prescribed>& p, const std::string& text) {
        CHECK_THROWS_AS(solve_static(a, p), std::invalid_argument);
        CHECK_THROWS_WITH(solve_static(a, p), Catch::Contains(text) && !Catch::Contains("\n"));
    };
    refused({ { n, std::nan("") } }, "finite");
    refused({ { -1, 0.0 } }, "index");
    refused({ { size, 0.0 } }, "index");
    refused({ { n + 1, 0.0 } }, "index");  // the second lane is padding
    refused({ { n, 0.0 }, { n, 1e-3 } }, "another value");
    const Array<double> short_loads(3, 0.0);
    CHECK_THROWS_AS(solve_static(a, {}, &short_loads), std::invalid_argument);
    Array<double> bad_loads(size, 0.0);
    bad_loads[n] = HUGE_VAL;
    CHECK_THROWS_AS(solve_static(a, {}, &bad_loads), std::invalid_argument);
}
