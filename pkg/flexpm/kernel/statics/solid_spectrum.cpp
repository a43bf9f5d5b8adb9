// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/statics/solid_spectrum.hpp>

#include <flexpm/kernel/core/random.hpp>
#include <flexpm/kernel/statics/solid_field.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/step/solid_masses.hpp>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <vector>

namespace flexpm {

namespace {

using Numbers = Eigen::VectorXd;

/// A few rounds may mistake a lower frequency for the largest.
constexpr int least_rounds = 20, most_rounds = 80;
/// Part of the eigenvalue below which what is left of a vector is round-off [-].
constexpr double round_off = 1e-10;
/// Residual of the largest eigenvalue at which it is known well enough [-].
constexpr double known = 0.01;

/// Roots of the inverse masses of the unknowns of grains that deform.
Numbers roots_of_nodes(const SolidState& s, std::size_t nodes)
{
    Numbers roots(static_cast<Eigen::Index>(3 * nodes));
    Eigen::Index next = 0;
    for_each_node(s, [&](int grain, int number) {
        const int node = s.grains.node(grain, number);
        for (int axis = 0; axis < 3; ++axis) {
            const bool held = s.grains.prescribed[s.grains.component(node, axis)];
            const double inverse = s.grains.inverse_mass[s.grains.scalar_index(node)];
            roots[next++] = held ? 0.0 : std::sqrt(inverse);
        }
    });
    return roots;
}

/// The same of rigid grains with inertias that are the same about all axes.
Numbers roots_of_bodies(const SolidState& s)
{
    Numbers roots(static_cast<Eigen::Index>(6) * s.grains.count);
    for (int g = 0; g < s.grains.count; ++g) {
        const double mass = s.grains.inverse_mass[s.grains.scalar_index(s.grains.centre(g))];
        const double turn = s.grains.radius[g] / std::sqrt(s.bodies[g].inertia.xx);
        for (int axis = 0; axis < 3; ++axis) {
            roots[6 * g + axis] = std::sqrt(mass);
            roots[6 * g + 3 + axis] = turn;
        }
    }
    return roots;
}

/// Largest eigenvalue of R K R with a diagonal R, plus what its residual leaves open.
double largest_eigenvalue(const LinearForces& forces, const Numbers& roots)
{
    Random random(1);
    Numbers now(roots.size()), before = Numbers::Zero(roots.size());
    for (Eigen::Index i = 0; i < now.size(); ++i)
        now[i] = roots[i] > 0.0 ? random.next() - 0.5 : 0.0;
    now /= now.norm();
    std::vector<double> diagonal, beside;
    double found = 0.0;
    for (int round = 0; round < most_rounds; ++round) {
        const Numbers way = roots.cwiseProduct(now);
        Numbers next = Numbers::Zero(now.size());
        forces.add(way.data(), next.data());
        next = roots.cwiseProduct(next).eval();
        diagonal.push_back(now.dot(next));
        next -= diagonal.back() * now;
        if (!beside.empty()) next -= beside.back() * before;
        beside.push_back(next.norm());
        const auto size = static_cast<Eigen::Index>(diagonal.size());
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
        solver.computeFromTridiagonal(Eigen::Map<Numbers>(diagonal.data(), size),
            Eigen::Map<Numbers>(beside.data(), size - 1));
        found = solver.eigenvalues()[size - 1];
        const double open = beside.back() * std::fabs(solver.eigenvectors()(size - 1, size - 1));
        const bool over = !(beside.back() > round_off * found);
        if (over || (round >= least_rounds && open < known * found)) return found + open;
        before = now;
        now = next / beside.back();
    }
    return (1.0 + known) * found;
}

}  // namespace

double largest_square_frequency(const SolidState& s)
{
    const LinearSolid solid = linear_solid(s);
    if (s.bodies.empty()) return largest_eigenvalue(solid, roots_of_nodes(s, solid.places.size()));
    return largest_eigenvalue(rigid_solid(s, solid), roots_of_bodies(s));
}

void scale_masses_closely(SolidState& s, double damping, double dt)
{
    scale_masses(s, damping, dt);
    const double largest = largest_square_frequency(s);
    if (largest == 0.0) return;  // nothing swings, as a rigid grain alone
    // stable below 2 / sqrt(1 + alpha) in a step; the bound never asks for less than is needed
    const double limit = 4.0 / (mass_margin * (1.0 + damping) * dt * dt);
    const double factor = std::min(largest / limit, 1.0);
    for (double& inverse : s.grains.inverse_mass)
        inverse /= factor;
    for (RigidBody& body : s.bodies)
        body.inertia = { factor * body.inertia.xx, factor * body.inertia.yy,
            factor * body.inertia.zz, factor * body.inertia.yz, factor * body.inertia.xz,
            factor * body.inertia.xy };
}

}  // namespace flexpm
