// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/iteration/free_solve.hpp>

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/iteration/free_motions.hpp>

#include <Eigen/Dense>
#include <Eigen/IterativeLinearSolvers>

#include <string>

namespace flexpm {
namespace {

/// Residual, relative to the load, at which forces are in balance.
constexpr double balanced = 1e-12;
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
        const Eigen::Ref<const flexpm::Numbers> u(right);
        flexpm::Numbers forces = flexpm::Numbers::Zero(left.rows());
        left.on().forces.add(u.data(), forces.data());
        left.on().project(forces);
        to.noalias() += factor * forces;
    }
};
}  // namespace Eigen::internal

namespace flexpm {
namespace {

/// Inverse blocks on the diagonal, of the free components, and motions that reach further.
class LevelsPreconditioner {
public:
    template <class Matrix> LevelsPreconditioner& compute(const Matrix& matrix)
    {
        blocks_ = matrix.on().forces.diagonal_blocks();
        stiffness_ = blocks_.mean_diagonal();
        blocks_.invert(matrix.on().held);
        wide_ = matrix.on().forces.wide_motions(matrix.on().held);
        return *this;
    }
    template <class Matrix> LevelsPreconditioner& analyzePattern(const Matrix&) { return *this; }
    template <class Matrix> LevelsPreconditioner& factorize(const Matrix& m) { return compute(m); }
    Numbers solve(const Numbers& right) const
    {
        Numbers result(right.size());
        blocks_.multiply(right.data(), result.data());
        for (const auto& one : wide_)
            one->add(right.data(), result.data());
        return result;
    }
    Eigen::ComputationInfo info() const { return Eigen::Success; }
    double stiffness() const { return stiffness_; }

private:
    double stiffness_ = 0.0;  ///< mean of the diagonal [N/m]
    DiagonalBlocks blocks_ { {} };
    std::vector<std::unique_ptr<WideMotions>> wide_;
};

/// Numbers as Eigen takes them, in their place.
Eigen::Map<const Numbers> numbers(const std::vector<double>& values)
{
    return { values.data(), static_cast<Eigen::Index>(values.size()) };
}

}  // namespace

FreeSolution solve_free(const LinearForces& forces, const std::vector<std::uint8_t>& held,
    std::vector<double> load, const std::vector<double>& guess)
{
    const Operator on { forces, held };
    Numbers right = numbers(load);
    load = std::vector<double>();  // of a large solid each vector of unknowns is 0.1 GB
    on.project(right);
    const FreeStiffness matrix(on);
    Eigen::ConjugateGradient<FreeStiffness, Eigen::Lower | Eigen::Upper, LevelsPreconditioner>
        solver;
    solver.setTolerance(balanced);
    solver.setMaxIterations(most_iterations);
    solver.compute(matrix);
    Numbers found = solver.solveWithGuess(right, numbers(guess));
    if (solver.info() != Eigen::Success) {
        fail("elastic solution: residual", number(solver.error()),
            "must be below " + number(balanced) + " after " + std::to_string(most_iterations)
                + " iterations; check the stiffness of contacts against that of grains");
    }
    const FreeMotions free(forces, held, solver.preconditioner().stiffness());
    if (free.count() > 0) {
        found -= numbers(guess);
        free.remove(found.data());
        found += numbers(guess);
    }
    return { { found.data(), found.data() + found.size() }, static_cast<int>(solver.iterations()),
        solver.error() };
}

}  // namespace flexpm
