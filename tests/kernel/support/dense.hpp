// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Dense matrices of small assemblies, for eigenvalues. SI units.
#pragma once

#include <flexpm/kernel/statics/stiffness_matrix.hpp>

#include <Eigen/Dense>

#include <vector>

namespace dense {

/// Entries of Assembly::displacement that belong to grains, ascending by grain and node.
inline std::vector<int> components(const flexpm::Assembly& a)
{
    std::vector<int> index;
    for (int g = 0; g < a.grains.count; ++g) {
        for (int n = 0; n < a.grains.nodes_of(g); ++n) {
            index.push_back(a.grains.node(g, n));
            index.push_back(a.grains.node(g, n) + flexpm::lanes);
        }
    }
    return index;
}

/// Stiffness in the order of components() [N/m].
inline Eigen::MatrixXd stiffness(const flexpm::Assembly& a)
{
    const std::vector<int> index = components(a);
    std::vector<int> number(a.grains.displacement.size(), -1);
    for (std::size_t i = 0; i < index.size(); ++i)
        number[index[i]] = static_cast<int>(i);
    const Eigen::Index n = static_cast<Eigen::Index>(index.size());
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n, n);
    for (const auto& e : flexpm::stiffness_entries(a))
        k(number[e.row], number[e.column]) += e.value;
    return k;
}

/// Nodal masses in the order of components() [kg].
inline Eigen::VectorXd masses(const flexpm::Assembly& a)
{
    const std::vector<int> index = components(a);
    Eigen::VectorXd m(static_cast<Eigen::Index>(index.size()));
    for (std::size_t i = 0; i < index.size(); i += 2) {
        m[static_cast<Eigen::Index>(i)] = m[static_cast<Eigen::Index>(i) + 1] =
            1.0 / a.grains.inverse_mass[flexpm::scalar_index(index[i])];
    }
    return m;
}

/// Eigenvalues of M^-1 K, ascending [1/s^2], and modes with unit modal mass.
struct Modes {
    Eigen::VectorXd squared_frequency;
    Eigen::MatrixXd shape;
};

inline Modes modes(const flexpm::Assembly& a)
{
    const Eigen::VectorXd scale = masses(a).cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd k = scale.asDiagonal() * stiffness(a) * scale.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(k);
    return { solver.eigenvalues(), scale.asDiagonal() * solver.eigenvectors() };
}

/// Largest eigenvalue of M^-1 K [1/s^2].
inline double largest_eigenvalue(const flexpm::Assembly& a)
{
    const Eigen::VectorXd scale = masses(a).cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd k = scale.asDiagonal() * stiffness(a) * scale.asDiagonal();
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k, Eigen::EigenvaluesOnly)
        .eigenvalues()
        .tail(1)[0];
}

}  // namespace dense
