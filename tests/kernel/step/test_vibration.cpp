// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Frequencies and stability limit of the stepped assembly against the eigenvalues of its
/// stiffness and mass matrices, paper Sec. 2.4. SI units.
#include "support/dense.hpp"
#include "support/specimens.hpp"

#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/step/step.hpp>

#include "support/catch.hpp"

#include <cmath>

using namespace flexpm;

namespace {

/// Steps `a`, pushed along mode `m`, without damping; returns the circular frequency [1/s] over
/// `periods` periods, from the zero crossings of the mode's amplitude.
double stepped_frequency(
    Assembly a, const dense::Modes& modes, Eigen::Index m, double dt, int periods)
{
    const std::vector<int> index = dense::components(a);
    const Eigen::VectorXd mass = dense::masses(a), shape = modes.shape.col(m);
    const double omega = std::sqrt(modes.squared_frequency[m]);
    // velocities, not displacements: contacts only know what the steps have done
    const double amplitude = 1e-12 / shape.cwiseAbs().maxCoeff();  // 1e-9 of the grain: linear
    for (std::size_t i = 0; i < index.size(); ++i) {
        a.grains.velocity[index[i]] = amplitude * omega * shape[static_cast<Eigen::Index>(i)];
    }
    StepOptions o;
    o.dt = dt;
    o.damping = 0.0;
    std::vector<double> crossings { 0.0 };
    double before = 0.0;
    for (int n = 1; static_cast<int>(crossings.size()) <= 2 * periods; ++n) {
        step(a, o);
        double now = 0.0;
        for (std::size_t i = 0; i < index.size(); ++i) {
            const Eigen::Index k = static_cast<Eigen::Index>(i);
            now += shape[k] * mass[k] * a.grains.displacement[index[i]];
        }
        if (now * before < 0.0) crossings.push_back(dt * (n - now / (now - before)));
        before = now;
        if (n * dt * omega > 4.0 * M_PI * periods) return 0.0;
    }
    return 2.0 * M_PI * periods / crossings.back();
}

/// Checks all modes but the rigid ones, of which there must be three.
void check_frequencies(Assembly a)
{
    const double dt = 0.2 * set_real_masses(a, 0.0);
    const int periods = 4;
    const dense::Modes modes = dense::modes(a);
    const double largest = modes.squared_frequency.tail(1)[0];
    CHECK(modes.squared_frequency.head(3).cwiseAbs().maxCoeff() < 1e-12 * largest);
    CHECK(modes.squared_frequency[3] > 1e-6 * largest);
    for (Eigen::Index m = 3; m < modes.squared_frequency.size(); ++m) {
        // central differences: sin(stepped dt / 2) = omega dt / 2
        const double omega = std::sqrt(modes.squared_frequency[m]);
        const double expected = 2.0 / dt * std::asin(0.5 * omega * dt);
        INFO("mode " << m << " of " << modes.squared_frequency.size());
        // straight lines through the crossings err by up to (omega dt)^3 / 16 of a radian
        const double error = std::pow(omega * dt, 3) / 16.0 / (2.0 * M_PI * periods);
        CHECK(stepped_frequency(a, modes, m, dt, periods)
            == Approx(expected).epsilon(std::max(error, 1e-7)));
    }
}

AssemblyOptions with(MeshKind mesh, int points, bool on_centre_line = false)
{
    AssemblyOptions o = specimens::options();
    o.mesh = mesh;
    o.points = points;
    o.on_centre_line = on_centre_line;
    return o;
}

}  // namespace

TEST_CASE("a free grain vibrates at the frequencies of its matrices", "[vibration]")
{
    for (const MeshKind mesh : { MeshKind::fan, MeshKind::refined }) {
        check_frequencies(specimens::assemble(specimens::hexagon(), with(mesh, 3)));
    }
}

TEST_CASE("two bonded grains vibrate at the frequencies of their matrices", "[vibration]")
{
    check_frequencies(specimens::assemble(specimens::grid(2, 1, 2e-3), with(MeshKind::fan, 3)));
}

TEST_CASE("real masses add up to the specimen's", "[vibration]")
{
    const double width = 0.02, height = 0.04;
    Assembly a =
        specimens::assemble(specimens::random_grains(width, height, 3e-3, 4), specimens::options());
    set_real_masses(a, 0.7);
    CHECK(0.5 * dense::masses(a).sum()
        == Approx(2650.0 * width * height * specimens::thickness).epsilon(1e-12));
}

TEST_CASE("masses keep every mode below the limit of damped central differences",
    "[vibration][eigenvalues]")
{
    const auto set_up = GENERATE(std::make_pair(3, false), std::make_pair(2, false),
        std::make_pair(1, false), std::make_pair(1, true));
    const auto mesh = GENERATE(MeshKind::fan, MeshKind::refined);
    for (const std::uint64_t seed : { 1u, 2u, 3u }) {
        Assembly a = specimens::assemble(specimens::random_grains(0.015, 0.012, 3e-3, seed),
            with(mesh, set_up.first, set_up.second));
        INFO(
            "points " << set_up.first << ", on centre line " << set_up.second << ", seed " << seed);
        const double damping = 0.7, limit = 4.0 / (1.0 + damping) / mass_margin;
        scale_masses(a, damping);
        CHECK(dense::largest_eigenvalue(a) <= limit * (1.0 + 1e-12));
        const double dt = set_real_masses(a, damping);
        CHECK(dense::largest_eigenvalue(a) * dt * dt <= limit * (1.0 + 1e-12));
    }
}

TEST_CASE("scaled masses go with the time step squared and with 1 + damping", "[vibration]")
{
    Assembly a = specimens::assemble(specimens::hexagon(), specimens::options());
    scale_masses(a, 0.0);
    const double unit = dense::masses(a)[0];
    scale_masses(a, 0.7, 1e-3);
    CHECK(dense::masses(a)[0] == Approx(1.7e-6 * unit).epsilon(1e-14));
    const double dt = set_real_masses(a, 0.0);
    CHECK(set_real_masses(a, 0.7) == Approx(dt / std::sqrt(1.7)).epsilon(1e-14));
}

TEST_CASE("the bound is not wasteful: within a factor of three of the limit", "[vibration]")
{
    Assembly a =
        specimens::assemble(specimens::random_grains(0.015, 0.012, 3e-3, 5), specimens::options());
    scale_masses(a, 0.7);
    CHECK(dense::largest_eigenvalue(a) > 4.0 / 1.7 / 3.0);
}

TEST_CASE("wrong damping and time step are refused", "[vibration]")
{
    Assembly a = specimens::assemble(specimens::hexagon(), specimens::options());
    for (const double bad : { -0.1, 1.0, 2.0, std::nan("") }) {
        CHECK_THROWS_WITH(scale_masses(a, bad), Catch::Contains("damping"));
        CHECK_THROWS_WITH(set_real_masses(a, bad), Catch::Contains("damping"));
    }
    for (const double bad : { 0.0, -1.0, std::nan("") }) {
        CHECK_THROWS_WITH(scale_masses(a, 0.7, bad), Catch::Contains("time step"));
    }
}
