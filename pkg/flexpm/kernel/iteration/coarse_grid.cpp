// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/iteration/coarse_grid.hpp>

#include <flexpm/kernel/fem/gradient_products.hpp>

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>

namespace flexpm {

namespace {

constexpr int corners = 8, size = 3 * corners;
/// Fewer iterations with less cost more time for the factors.
constexpr double grains_in_brick = 10.0;
/// Their factors take seconds.
constexpr double most_bricks = 5000.0;
/// Stiffness that all motions of the grid meet, relative to that on the diagonal.
constexpr double little = 1e-6;

/// Corner k of a brick is at its high side along x, y, z by the bits of k.
bool is_high(int corner, int axis) { return (corner >> axis & 1) != 0; }

std::array<double, corners> weights_at(const std::array<double, 3>& at)
{
    std::array<double, corners> weights;
    for (int k = 0; k < corners; ++k) {
        weights[k] = 1.0;
        for (int axis = 0; axis < 3; ++axis)
            weights[k] *= is_high(k, axis) ? at[axis] : 1.0 - at[axis];
    }
    return weights;
}

/// Gradients of the weights, per edge of a brick.
std::array<Vector, corners> gradients_at(const std::array<double, 3>& at)
{
    std::array<Vector, corners> gradients;
    for (int k = 0; k < corners; ++k) {
        double along[3];
        for (int axis = 0; axis < 3; ++axis) {
            along[axis] = is_high(k, axis) ? 1.0 : -1.0;
            for (int other = 0; other < 3; ++other)
                if (other != axis) along[axis] *= is_high(k, other) ? at[other] : 1.0 - at[other];
        }
        gradients[k] = { along[0], along[1], along[2] };
    }
    return gradients;
}

/// f 1 + a b^T
SpaceGradient dyad(double f, Vector a, Vector b)
{
    SpaceGradient sum { a.x * b, a.y * b, a.z * b };
    sum.x.x += f;
    sum.y.y += f;
    sum.z.z += f;
    return sum;
}

using Numbers = Eigen::VectorXd;

}  // namespace

struct CoarseGrid::Factors {
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> of;
};

CoarseGrid::CoarseGrid(
    const std::vector<Vector>& nodes, const std::vector<Vector>& centres, Moves moves) :
    edge_(1.0)
{
    if (nodes.empty()) return;
    Vector high = low_ = nodes.front();
    for (Vector p : nodes) {
        low_ = { std::min(low_.x, p.x), std::min(low_.y, p.y), std::min(low_.z, p.z) };
        high = { std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z) };
    }
    const double sides[] = { high.x - low_.x, high.y - low_.y, high.z - low_.z };
    const double bricks =
        std::clamp(static_cast<double>(centres.size()) / grains_in_brick, 1.0, most_bricks);
    edge_ = std::cbrt(sides[0] * sides[1] * sides[2] / bricks);
    std::size_t count = 1;
    for (int axis = 0; axis < 3; ++axis) {
        bricks_[axis] = std::max(1, static_cast<int>(std::ceil(sides[axis] / edge_ - 1e-9)));
        count *= bricks_[axis];
    }
    stiffness_.assign(count * size * size, 0.0);
    const std::vector<Vector>& places = moves == Moves::nodes ? nodes : centres;
    seats_.reserve(places.size());
    for (Vector p : places)
        seats_.push_back(seat(p));
}

CoarseGrid::Seat CoarseGrid::seat(Vector place) const
{
    const Vector way = (1.0 / edge_) * (place - low_);
    const double along[] = { way.x, way.y, way.z };
    Seat seat { 0, {} };
    int step = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const int brick = std::clamp(static_cast<int>(along[axis]), 0, bricks_[axis] - 1);
        seat.brick += step * brick;
        seat.from_low[axis] = along[axis] - brick;
        step *= bricks_[axis];
    }
    return seat;
}

std::array<int, 8> CoarseGrid::vertices(int brick) const
{
    const int at[] = { brick % bricks_[0], brick / bricks_[0] % bricks_[1],
        brick / (bricks_[0] * bricks_[1]) };
    std::array<int, corners> found {};
    for (int k = 0; k < corners; ++k)
        found[k] = at[0] + is_high(k, 0)
            + (bricks_[0] + 1)
                * (at[1] + is_high(k, 1) + (bricks_[1] + 1) * (at[2] + is_high(k, 2)));
    return found;
}

int CoarseGrid::unknowns() const
{
    return 3 * (bricks_[0] + 1) * (bricks_[1] + 1) * (bricks_[2] + 1);
}

void CoarseGrid::add_block(int brick, int a, int b, const SpaceGradient& k)
{
    const Vector rows[] = { k.x, k.y, k.z };
    double* to = stiffness_.data() + static_cast<std::size_t>(brick) * size * size;
    for (int i = 0; i < 3; ++i) {
        double* row = to + (3 * a + i) * size + 3 * b;
        row[0] += rows[i].x;
        row[1] += rows[i].y;
        row[2] += rows[i].z;
    }
}

void CoarseGrid::add_volume(Vector place, double volume, const PlaneStiffness& c)
{
    const Seat at = seat(place);
    const auto gradients = gradients_at(at.from_low);
    const double factor = volume / (edge_ * edge_);
    for (int a = 0; a < corners; ++a)
        for (int b = 0; b < corners; ++b)
            add_block(at.brick, a, b, stiffness_block(gradients[a], gradients[b], factor, c));
}

void CoarseGrid::add_spring(Vector place, const SpaceGradient& k)
{
    const Seat at = seat(place);
    const auto weights = weights_at(at.from_low);
    for (int a = 0; a < corners; ++a) {
        for (int b = 0; b < corners; ++b) {
            const double w = weights[a] * weights[b];
            add_block(at.brick, a, b, { w * k.x, w * k.y, w * k.z });
        }
    }
}

/// Add a spring whose ends part by shares of the motions of the corners.
void CoarseGrid::add_spring(
    int brick, const std::array<SpaceGradient, 8>& shares, const SpaceGradient& k)
{
    for (int b = 0; b < corners; ++b) {
        const SpaceGradient forces = product(k, shares[b]);
        for (int a = 0; a < corners; ++a)
            add_block(brick, a, b, product(transposed(shares[a]), forces));
    }
}

void CoarseGrid::add_spring(int grain, Vector arm, const SpaceGradient& k)
{
    const Seat& at = seats_[grain];
    const auto weights = weights_at(at.from_low);
    const auto gradients = gradients_at(at.from_low);
    std::array<SpaceGradient, corners> shares;
    for (int a = 0; a < corners; ++a) {
        const Vector half = (0.5 / edge_) * gradients[a];
        shares[a] = dyad(weights[a] + dot(half, arm), half, -arm);  // turned by half of the curl
    }
    add_spring(at.brick, shares, k);
}

void CoarseGrid::add_contact(Vector place, Vector branch, const SpaceGradient& k)
{
    const Seat at = seat(place);
    const auto gradients = gradients_at(at.from_low);
    std::array<SpaceGradient, corners> shares;
    for (int a = 0; a < corners; ++a) {
        const Vector half = (0.5 / edge_) * gradients[a];
        shares[a] = dyad(dot(half, branch), half, branch);  // strain alone opens it
    }
    add_spring(at.brick, shares, k);
}

void CoarseGrid::factorize()
{
    std::vector<Eigen::Triplet<double>> entries;
    const int bricks = static_cast<int>(stiffness_.size() / (size * size));
    for (int brick = 0; brick < bricks; ++brick) {
        const auto on = vertices(brick);
        const double* row = stiffness_.data() + static_cast<std::size_t>(brick) * size * size;
        for (int i = 0; i < size; ++i, row += size)
            for (int j = 0; j < size; ++j)
                if (row[j] != 0.0)
                    entries.emplace_back(3 * on[i / 3] + i % 3, 3 * on[j / 3] + j % 3, row[j]);
    }
    Eigen::SparseMatrix<double> matrix(unknowns(), unknowns());
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Numbers diagonal = matrix.diagonal();
    const double mean = diagonal.mean();
    for (int i = 0; i < unknowns(); ++i)
        matrix.coeffRef(i, i) += little * (diagonal[i] + mean);
    auto factors = std::make_shared<Factors>();
    factors->of.compute(matrix);
    if (factors->of.info() == Eigen::Success) factors_ = std::move(factors);
}

void CoarseGrid::add_motion(
    const std::vector<std::uint8_t>& held, const double* forces, double* motion) const
{
    if (!factors_) return;
    Numbers loads = Numbers::Zero(unknowns());
    const auto for_each_share = [&](auto give) {
        int brick = -1;
        std::array<int, corners> on {};
        for (std::size_t n = 0; n < seats_.size(); ++n) {
            const Seat& at = seats_[n];
            if (at.brick != brick) on = vertices(brick = at.brick);  // most nodes follow neighbours
            const auto weights = weights_at(at.from_low);
            for (int k = 0; k < corners; ++k)
                for (int axis = 0; axis < 3; ++axis)
                    if (!held[3 * n + axis]) give(3 * n + axis, 3 * on[k] + axis, weights[k]);
        }
    };
    for_each_share([&](std::size_t i, int to, double weight) { loads[to] += weight * forces[i]; });
    const Numbers ways = factors_->of.solve(loads);
    for_each_share(
        [&](std::size_t i, int from, double weight) { motion[i] += weight * ways[from]; });
}

std::vector<GridMotion> CoarseGrid::motions(const std::vector<GridMotion>& loads) const
{
    std::vector<GridMotion> found(factors_ ? loads.size() : 0);
    if (found.empty()) return found;
    Numbers on_grid = Numbers::Zero(unknowns());
    const auto for_each_share = [&](auto give) {
        for (std::size_t g = 0; g < seats_.size(); ++g) {
            const auto on = vertices(seats_[g].brick);
            const auto weights = weights_at(seats_[g].from_low);
            const auto gradients = gradients_at(seats_[g].from_low);
            for (int k = 0; k < corners; ++k)
                give(g, 3 * on[k], weights[k], (0.5 / edge_) * gradients[k]);
        }
    };
    for_each_share([&](std::size_t g, int to, double weight, Vector half) {
        const Vector f = weight * loads[g].way + cross(loads[g].turn, half);
        on_grid[to] += f.x;
        on_grid[to + 1] += f.y;
        on_grid[to + 2] += f.z;
    });
    const Numbers ways = factors_->of.solve(on_grid);
    for_each_share([&](std::size_t g, int from, double weight, Vector half) {
        const Vector u { ways[from], ways[from + 1], ways[from + 2] };
        found[g].way = found[g].way + weight * u;
        found[g].turn = found[g].turn + cross(half, u);
    });
    return found;
}

}  // namespace flexpm
