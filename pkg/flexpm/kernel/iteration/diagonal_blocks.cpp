// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/iteration/diagonal_blocks.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace flexpm {

namespace {

using Block = Eigen::Map<Eigen::MatrixXd>;

/// Inverse of a block of one triple.
void invert_triple(Block block)
{
    Eigen::Matrix3d one = block;
    const double size = one.norm();
    if (!(std::fabs(one.determinant()) > 1e-12 * size * size * size))
        one.diagonal().array() += size > 0.0 ? 1e-3 * size : 1.0;
    block = one.inverse().eval();
}

void invert_group(Block block)
{
    Eigen::LLT<Eigen::MatrixXd> factor(block);
    if (factor.info() != Eigen::Success || !(factor.rcond() > 1e-12)) {
        block.diagonal().array() += 1e-3 * block.norm();
        factor.compute(block);
    }
    block = factor.solve(Eigen::MatrixXd::Identity(block.rows(), block.cols()));
}

}  // namespace

DiagonalBlocks::DiagonalBlocks(const std::vector<int>& group_of) :
    members_(group_of.size()),
    group_(group_of),
    place_(group_of.size())
{
    const int groups =
        group_of.empty() ? 0 : 1 + *std::max_element(group_of.begin(), group_of.end());
    first_.resize(groups + 1, 0);
    for (std::size_t t = 0; t < group_of.size(); ++t)
        place_[t] = first_[group_of[t] + 1]++;
    for (int g = 0; g < groups; ++g) {
        const auto size = static_cast<std::size_t>(3) * first_[g + 1];
        start_.push_back(start_.back() + size * size);
        first_[g + 1] += first_[g];
    }
    for (std::size_t t = 0; t < group_of.size(); ++t)
        members_[first_[group_of[t]] + place_[t]] = static_cast<int>(t);
    values_.resize(start_.back(), 0.0);
}

void DiagonalBlocks::add(int row, int column, double factor, const SpaceGradient& k)
{
    const int group = group_[row];
    if (group != group_[column]) return;
    const int size = 3 * triples(group);
    const Vector rows[] = { k.x, k.y, k.z };
    for (int i = 0; i < 3; ++i) {
        const double of_row[] = { rows[i].x, rows[i].y, rows[i].z };
        for (int j = 0; j < 3; ++j)
            values_[start_[group] + (3 * place_[column] + j) * size + 3 * place_[row] + i] +=
                factor * of_row[j];
    }
}

void DiagonalBlocks::append(const SpaceGradient& k)
{
    const int triple = static_cast<int>(members_.size()),
              group = static_cast<int>(first_.size()) - 1;
    members_.push_back(triple);
    group_.push_back(group);
    place_.push_back(0);
    first_.push_back(triple + 1);
    start_.push_back(start_.back() + 9);
    values_.resize(start_.back(), 0.0);
    add(triple, triple, 1.0, k);
}

double DiagonalBlocks::mean_diagonal() const
{
    double sum = 0.0;
    for (std::size_t g = 0; g + 1 < first_.size(); ++g) {
        const int size = 3 * triples(static_cast<int>(g));
        for (int i = 0; i < size; ++i)
            sum += values_[start_[g] + i * (size + 1)];
    }
    return sum / (3.0 * static_cast<double>(members_.size()));
}

void DiagonalBlocks::invert(const std::vector<std::uint8_t>& held)
{
    for (std::size_t g = 0; g + 1 < first_.size(); ++g) {
        const int count = triples(static_cast<int>(g)), size = 3 * count;
        Block block(values_.data() + start_[g], size, size);
        for (int i = 0; i < size; ++i) {
            if (!held[3 * members_[first_[g] + i / 3] + i % 3]) continue;
            block.row(i).setZero();
            block.col(i).setZero();
            block(i, i) = 1.0;
        }
        if (count == 1)
            invert_triple(block);
        else
            invert_group(block);
    }
}

void DiagonalBlocks::multiply(const double* right, double* to) const
{
    std::vector<double> sums;
    for (std::size_t g = 0; g + 1 < first_.size(); ++g) {
        const int* own = members_.data() + first_[g];
        const int size = 3 * triples(static_cast<int>(g));
        const double* column = values_.data() + start_[g];
        sums.assign(size, 0.0);
        for (int j = 0; j < size; ++j, column += size) {
            const double value = right[3 * own[j / 3] + j % 3];
            for (int i = 0; i < size; ++i)
                sums[i] += column[i] * value;
        }
        for (int i = 0; i < size; ++i)
            to[3 * own[i / 3] + i % 3] = sums[i];
    }
}

}  // namespace flexpm
