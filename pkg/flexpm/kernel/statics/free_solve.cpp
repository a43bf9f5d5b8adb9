// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/statics/free_solve.hpp>

#include <flexpm/kernel/core/require.hpp>

#include <Eigen/Dense>
#include <Eigen/IterativeLinearSolvers>

#include <cmath>
#include <string>

namespace flexpm {
namespace {

/// Residual, relative to the load, at which forces are in balance.
constexpr double balanced = 1e-10;
constexpr int most_iterations = 20000;

using Numbers = Eigen::VectorXd;

/// Unknowns that are free to move, and the stiffness between them.
struct Operator {
    const LinearForces& forces;
    const std::vector<std::uint8_t>& held;

    void project(Numbers& u) const
    {
        for (std::size_t k = 0; k < held.size(); ++k)
            if (held[k]) u[static_cast<Eigen::Index>(k)] = 0.0;
    }
};

}  // namespace

/// The operator as a matrix that Eigen's solvers multiply with.
class FreeStiffness;

}  // namespace flexpm

namespace Eigen::internal {
template <> struct traits<flexpm::FreeStiffness> : public traits<SparseMatrix<double>> {
};
}  // namespace Eigen::internal

namespace flexpm {

class FreeStiffness : public Eigen::EigenBase<FreeStiffness> {
public:
    using Scalar = double;
    using RealScalar = double;
    using StorageIndex = int;
    enum { ColsAtCompileTime = Eigen::Dynamic, MaxColsAtCompileTime = Eigen::Dynamic };
    enum { IsRowMajor = false };

    explicit FreeStiffness(const Operator& on) : on_(on) { }
    Eigen::Index rows() const { return static_cast<Eigen::Index>(on_.held.size()); }
    Eigen::Index cols() const { return rows(); }
    const Operator& on() const { return on_; }

    template <class Right>
    Eigen::Product<FreeStiffness, Right, Eigen::AliasFreeProduct> operator*(
        const Eigen::MatrixBase<Right>& right) const
    {
        return { *this, right.derived() };
    }

private:
    const Operator& on_;
};

}  // namespace flexpm

namespace Eigen::internal {
template <class Right>
struct generic_product_impl<flexpm::FreeStiffness, Right, SparseShape, DenseShape, GemvProduct>
    : generic_product_impl_base<flexpm::FreeStiffness, Right,
          generic_product_impl<flexpm::FreeStiffness, Right>> {
    template <class To>
    static void scaleAndAddTo(
        To& to, const flexpm::FreeStiffness& left, const Right& right, const double& factor)
    {
        const flexpm::Numbers u = right;
        flexpm::Numbers forces = flexpm::Numbers::Zero(left.rows());
        left.on().forces.add(u.data(), forces.data());
        left.on().project(forces);
        to.noalias() += factor * forces;
    }
};
}  // namespace Eigen::internal

namespace flexpm {
namespace {

/// Inverse diagonal blocks of the free components.
class BlockPreconditioner {
public:
    template <class Matrix> BlockPreconditioner& compute(const Matrix& matrix)
    {
        const Operator& on = matrix.on();
        for (const SpaceGradient& k : on.forces.diagonal_blocks()) {
            Eigen::Matrix3d m;
            m << k.x.x, k.x.y, k.x.z, k.y.x, k.y.y, k.y.z, k.z.x, k.z.y, k.z.z;
            blocks_.push_back(m);
        }
        for (std::size_t n = 0; n < blocks_.size(); ++n) {
            for (int k = 0; k < 3; ++k) {
                if (!on.held[3 * n + k]) continue;
                blocks_[n].row(k).setZero();
                blocks_[n].col(k).setZero();
                blocks_[n](k, k) = 1.0;
            }
            stiffen(blocks_[n]);
            blocks_[n] = blocks_[n].inverse().eval();
        }
        return *this;
    }
    template <class Matrix> BlockPreconditioner& analyzePattern(const Matrix&) { return *this; }
    template <class Matrix> BlockPreconditioner& factorize(const Matrix& m) { return compute(m); }
    Numbers solve(const Numbers& right) const
    {
        Numbers result(right.size());
        for (std::size_t n = 0; n < blocks_.size(); ++n) {
            const auto k = static_cast<Eigen::Index>(3 * n);
            result.segment<3>(k) = blocks_[n] * right.segment<3>(k);
        }
        return result;
    }
    Eigen::ComputationInfo info() const { return Eigen::Success; }

private:
    std::vector<Eigen::Matrix3d> blocks_;

    /// A block that resists no motion in some way, as of a grain that one point holds, gets a
    /// little stiffness there: it has no inverse otherwise.
    static void stiffen(Eigen::Matrix3d& block)
    {
        const double size = block.norm();
        if (std::fabs(block.determinant()) > 1e-12 * size * size * size) return;
        block.diagonal().array() += size > 0.0 ? 1e-3 * size : 1.0;
    }
};

Numbers numbers(const std::vector<double>& values)
{
    return Eigen::Map<const Numbers>(values.data(), static_cast<Eigen::Index>(values.size()));
}

}  // namespace

FreeSolution solve_free(const LinearForces& forces, const std::vector<std::uint8_t>& held,
    std::vector<double> load, const std::vector<double>& guess)
{
    const Operator on { forces, held };
    Numbers right = numbers(load);
    on.project(right);
    const FreeStiffness matrix(on);
    Eigen::ConjugateGradient<FreeStiffness, Eigen::Lower | Eigen::Upper, BlockPreconditioner>
        solver;
    solver.setTolerance(balanced);
    solver.setMaxIterations(most_iterations);
    solver.compute(matrix);
    const Numbers found = solver.solveWithGuess(right, numbers(guess));
    if (solver.info() != Eigen::Success) {
        fail("elastic solution: residual", number(solver.error()),
            "must be below " + number(balanced) + " after " + std::to_string(most_iterations)
                + " iterations; check the stiffness of contacts against that of grains");
    }
    return { { found.data(), found.data() + found.size() }, static_cast<int>(solver.iterations()),
        solver.error() };
}

}  // namespace flexpm
