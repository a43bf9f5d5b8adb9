// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/iteration/free_motions.hpp>

#include <Eigen/Dense>

namespace flexpm {

namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;

/// Stiffness of a motion, relative to the mean of the diagonal, that is rounding: a single spring of
/// ten million holds its motion by 1e-7.
constexpr double rounding = 1e-13;
/// Share of its own size by which a motion differs from the others, below which it is one of them.
constexpr double different = 1e-10;

/// Orthonormal combinations of motions whose inner products these are, as columns.
Eigen::MatrixXd orthonormal(const Matrix6& products)
{
    Vector6 scale = products.diagonal();
    for (double& s : scale)
        s = s > 0.0 ? 1.0 / std::sqrt(s) : 0.0;
    const Eigenvalues of(Eigen::MatrixXd(scale.asDiagonal() * products * scale.asDiagonal()));
    Eigen::MatrixXd columns(6, 0);
    for (Eigen::Index k = 0; k < 6; ++k) {
        if (!(of.eigenvalues()[k] > different)) continue;
        columns.conservativeResize(6, columns.cols() + 1);
        columns.rightCols(1) =
            scale.asDiagonal() * of.eigenvectors().col(k) / std::sqrt(of.eigenvalues()[k]);
    }
    return columns;
}

}  // namespace

/// Call visit(unknown, its displacement by each of the six unit motions) for those that are free.
template <class Visit> void FreeMotions::for_each_free(Visit visit) const
{
    for (std::size_t i = 0; i + 2 < held_.size(); i += 3) {
        const RigidPart part = forces_.rigid_part(static_cast<int>(i / 3));
        const Vector arm = part.arm;
        const Six rows[] = { { part.way, 0.0, 0.0, part.turn, arm.z, -arm.y },
            { 0.0, part.way, 0.0, -arm.z, part.turn, arm.x },
            { 0.0, 0.0, part.way, arm.y, -arm.x, part.turn } };
        for (int axis = 0; axis < 3; ++axis)
            if (!held_[i + axis]) visit(i + axis, rows[axis]);
    }
}

/// Inner products of values with the six unit motions.
FreeMotions::Six FreeMotions::sums(const double* values) const
{
    Six found {};
    for_each_free([&](std::size_t i, const Six& along) {
        for (int k = 0; k < 6; ++k)
            found[k] += along[k] * values[i];
    });
    return found;
}

FreeMotions::FreeMotions(
    const LinearForces& forces, const std::vector<std::uint8_t>& held, double stiffness) :
    forces_(forces),
    held_(held)
{
    Matrix6 products = Matrix6::Zero(), resisted;
    for_each_free([&](std::size_t, const Six& along) {
        const Eigen::Map<const Vector6> all(along.data());
        products += all * all.transpose();
    });
    std::vector<double> u(held.size()), on(held.size());
    for (int k = 0; k < 6; ++k) {
        for_each_free([&](std::size_t i, const Six& along) { u[i] = along[k]; });
        std::fill(on.begin(), on.end(), 0.0);
        forces.add(u.data(), on.data());
        const Six against = sums(on.data());
        for (int other = 0; other < 6; ++other)
            resisted(other, k) = against[other];
    }
    const Eigen::MatrixXd base = orthonormal(products);
    if (base.cols() == 0) return;
    const Eigenvalues of(Eigen::MatrixXd(base.transpose() * resisted * base));
    for (Eigen::Index k = 0; k < base.cols(); ++k) {
        if (of.eigenvalues()[k] > rounding * stiffness) continue;
        const Vector6 motion = base * of.eigenvectors().col(k);
        motions_.emplace_back();
        std::copy(motion.begin(), motion.end(), motions_.back().begin());
    }
}

void FreeMotions::remove(double* change) const
{
    const Six all = sums(change);
    Six removed {};
    for (const Six& motion : motions_) {
        double product = 0.0;
        for (int k = 0; k < 6; ++k)
            product += motion[k] * all[k];
        for (int k = 0; k < 6; ++k)
            removed[k] += product * motion[k];
    }
    for_each_free([&](std::size_t i, const Six& along) {
        for (int k = 0; k < 6; ++k)
            change[i] -= removed[k] * along[k];
    });
}

}  // namespace flexpm
