// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Newton's method for weights: its step is a sparse linear solve.
#include <flexpm/kernel/labels/given_volumes.hpp>

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <string>

namespace flexpm {
namespace {

/// Newton's step of the weights for a change of the volumes. The first point keeps its weight,
/// since a number added to all weights changes no volume.
std::vector<double> newton_step(
    const WeightedPoints& at, const WeightedCells& cells, const std::vector<double>& changes)
{
    const int free = cells.complex.cells - 1;
    std::vector<Eigen::Triplet<double>> entries;
    for (const CellFace& face : cells.complex.faces) {
        if (face.second < 0) continue;
        // a face moves along its normal by the change of weight over twice the points' distance
        const double rate = 0.5 * norm(area_vector(cells.complex, face.corners))
            / norm(at.points[face.second] - at.points[face.first]);
        const int a = face.first - 1, b = face.second - 1;
        if (a >= 0) entries.emplace_back(a, a, rate);
        entries.emplace_back(b, b, rate);
        if (a < 0) continue;
        entries.emplace_back(a, b, -rate);
        entries.emplace_back(b, a, -rate);
    }
    Eigen::SparseMatrix<double> matrix(free, free);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(matrix);
    const Eigen::VectorXd found =
        factors.solve(Eigen::Map<const Eigen::VectorXd>(changes.data() + 1, free));
    std::vector<double> step(changes.size(), 0.0);
    for (int i = 0; i < free; ++i)
        step[i + 1] = found[i];
    return step;
}

}  // namespace

std::vector<double> weights_of_volumes(const WeightedPoints& given, const Solid& solid,
    const std::vector<double>& volumes, double tolerance)
{
    constexpr int most_steps = 100;
    constexpr double smallest_part = 1e-6, unlike = 1e-9;
    const std::string name = "weights_of_volumes: volume";
    if (volumes.size() != given.points.size())
        refuse(name + "s", std::to_string(volumes.size()), "must be one a point; complete them");
    double sum = 0.0;
    for (std::size_t i = 0; i < volumes.size(); ++i) {
        check_positive(name + " " + std::to_string(i), volumes[i], "m^3");
        sum += volumes[i];
    }
    if (!(std::abs(sum - solid.volume) <= unlike * solid.volume)) {
        refuse(name + " of all cells", sum, "m^3",
            "must be that of the solid, " + number(solid.volume) + " m^3; scale them");
    }
    WeightedPoints at = given;
    WeightedCells cells = weighted_cells(at, solid);
    const auto error = [&](const WeightedCells& c) {
        double square = 0.0;
        for (std::size_t i = 0; i < volumes.size(); ++i)
            square += (volumes[i] - c.volumes[i]) * (volumes[i] - c.volumes[i]);
        return std::sqrt(square);
    };
    const auto least_of = [](const std::vector<double>& v) {
        return *std::min_element(v.begin(), v.end());
    };
    // no cell becomes smaller than half of the smallest one: the method's rule of damping
    const double least = 0.5 * std::min(least_of(cells.volumes), least_of(volumes));
    if (!(least > 0.0)) {
        refuse(name + " of a cell at the start", least_of(cells.volumes), "m^3",
            "must be above 0; choose weights that hide no point");
    }
    for (int step = 0; step < most_steps; ++step) {
        std::vector<double> changes;
        bool reached = true;
        for (std::size_t i = 0; i < volumes.size(); ++i) {
            changes.push_back(volumes[i] - cells.volumes[i]);
            reached = reached && std::abs(changes[i]) <= tolerance * volumes[i];
        }
        if (reached) return at.weights;
        const std::vector<double> whole = newton_step(at, cells, changes);
        const double before = error(cells);
        for (double part = 1.0;; part *= 0.5) {
            if (part < smallest_part)
                fail(name, number(before) + " m^3 off", "must be reached; move its point");
            WeightedPoints trial = at;
            for (std::size_t i = 0; i < whole.size(); ++i)
                trial.weights[i] += part * whole[i];
            WeightedCells found = weighted_cells(trial, solid);
            if (least_of(found.volumes) < least || error(found) > (1.0 - 0.5 * part) * before)
                continue;
            at = std::move(trial);
            cells = std::move(found);
            break;
        }
    }
    fail(name, "not reached", "must be within " + number(tolerance) + "; choose other points");
}

}  // namespace flexpm
