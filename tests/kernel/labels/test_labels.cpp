// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Power cells of weighted points, weights of given volumes, cells of voxels, and the fit of
/// labels.
#include <flexpm/kernel/labels/given_volumes.hpp>
#include <flexpm/kernel/labels/label_fit.hpp>
#include <flexpm/kernel/labels/voxel_cells.hpp>

#include "support/sphere_samples.hpp"

using namespace flexpm_test;

namespace {

constexpr double side = 0.0175;

Solid cube() { return Solid::box(side, side, side); }

WeightedPoints points_of(const std::vector<Sphere>& spheres)
{
    WeightedPoints found;
    for (const Sphere& s : spheres) {
        found.points.push_back(s.centre);
        found.weights.push_back(s.radius * s.radius);
    }
    return found;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b)
{
    REQUIRE(a.size() == b.size());
    double most = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        most = std::max(most, std::abs(a[i] / b[i] - 1.0));
    return most;
}

/// All labels compete for each voxel.
LabelSamples samples_of(const std::vector<int>& labels, const VoxelGrid& grid, int count)
{
    LabelSamples samples;
    for (std::size_t v = 0; v < labels.size(); ++v) {
        const auto n = static_cast<int>(v);
        const int i = n % grid.counts[0], j = n / grid.counts[0] % grid.counts[1],
                  k = n / (grid.counts[0] * grid.counts[1]);
        samples.points.push_back(
            { (i + 0.5) * grid.size.x, (j + 0.5) * grid.size.y, (k + 0.5) * grid.size.z });
        samples.labels.push_back(labels[v]);
        samples.weights.push_back(1.0);
    }
    for (int label = 0; label < count; ++label) {
        samples.rival_offsets.push_back(label * count);
        for (int rival = 0; rival < count; ++rival)
            samples.rivals.push_back(rival);
    }
    samples.rival_offsets.push_back(count * count);
    return samples;
}

}  // namespace

TEST_CASE("weighted points have the cells of their spheres, in any gauge", "[space]")
{
    const auto spheres = packed_spheres(cube(), 150, 3);
    const Polyhedra expected = polyhedra(spheres, cube(), { 0.0, false });
    WeightedPoints given = points_of(spheres);
    // |x - p|^2 - w is changed by the same number or linear function of x for all points, or is
    // multiplied by a number: this moves points out of their cells and out of the solid
    const Vector way { 0.4 * side, -0.7 * side, 0.2 * side };
    for (const double factor : { 1.0, 3.0 }) {
        CAPTURE(factor);
        WeightedPoints other;
        for (std::size_t i = 0; i < spheres.size(); ++i) {
            const Vector p = given.points[i], q = factor * p + way;
            other.points.push_back(q);
            // the score 2 p.x + w - p.p, times the factor, and 2 way.x
            other.weights.push_back(
                factor * (given.weights[i] - dot(p, p)) + dot(q, q) - 7.0 * side * side);
        }
        const WeightedCells cells = weighted_cells(other, cube());
        REQUIRE(largest_difference(cells.volumes, expected.volumes) < 1e-9);
        REQUIRE(count_contacts(cells.complex) == expected.contacts);
        REQUIRE(std::accumulate(cells.volumes.begin(), cells.volumes.end(), 0.0)
            == Approx(cube().volume).epsilon(1e-12));
    }
}

TEST_CASE("cells get the volumes that are given", "[space]")
{
    const auto spheres = packed_spheres(cube(), 120, 5);
    WeightedPoints at = points_of(spheres);
    const std::vector<double> known = weighted_cells(at, cube()).volumes;
    for (double& weight : at.weights)
        weight = 0.0;
    SECTION("those of other weights")
    {
        at.weights = weights_of_volumes(at, cube(), known, 1e-9);
        REQUIRE(largest_difference(weighted_cells(at, cube()).volumes, known) < 1e-9);
        // weights are unique but for a number that is added to all
        const double apart = at.weights[0] - spheres[0].radius * spheres[0].radius;
        for (std::size_t i = 0; i < spheres.size(); ++i)
            REQUIRE(
                std::abs(at.weights[i] - apart - spheres[i].radius * spheres[i].radius) < 1e-11);
    }
    SECTION("any volumes")
    {
        Random random(7);
        std::vector<double> volumes;
        double sum = 0.0;
        for (std::size_t i = 0; i < spheres.size(); ++i)
            sum += volumes.emplace_back(1.0 + 9.0 * random.next());
        for (double& v : volumes)
            v *= cube().volume / sum;
        at.weights = weights_of_volumes(at, cube(), volumes, 1e-8);
        REQUIRE(largest_difference(weighted_cells(at, cube()).volumes, volumes) < 1e-8);
    }
    SECTION("volumes that do not fill the solid are refused")
    {
        std::vector<double> volumes = known;
        volumes[3] *= 2.0;
        REQUIRE_THROWS_WITH(weights_of_volumes(at, cube(), volumes, 1e-8),
            Catch::Contains("must be that of the solid"));
    }
}

TEST_CASE("two points in one place are refused by their indices", "[space]")
{
    const WeightedPoints twice {
        { { 1e-3, 1e-3, 1e-3 }, { 2e-3, 1e-3, 1e-3 }, { 1e-3, 1e-3, 1e-3 } }, { 0.0, 0.0, 1e-7 }
    };
    REQUIRE_THROWS_WITH(weighted_cells(twice, cube()), Catch::Contains("point 2"));
}

TEST_CASE("voxels are in the cells of least power distance", "[space]")
{
    const WeightedPoints given = points_of(packed_spheres(cube(), 90, 2));
    const WeightedCells cells = weighted_cells(given, cube());
    const VoxelGrid grid { { 17, 23, 11 }, { side / 17, side / 23, side / 11 }, {} };
    const std::vector<int> found = cells_of_voxels(given, cells.complex, grid);
    REQUIRE(found.size() == 17 * 23 * 11);
    int wrong = 0;
    std::size_t at = 0;
    for (int k = 0; k < 11; ++k)
        for (int j = 0; j < 23; ++j)
            for (int i = 0; i < 17; ++i) {
                const Vector x { (i + 0.5) * grid.size.x, (j + 0.5) * grid.size.y,
                    (k + 0.5) * grid.size.z };
                int least = 0;
                const auto distance = [&](int c) {
                    const Vector d = x - given.points[c];
                    return dot(d, d) - given.weights[c];
                };
                for (int c = 1; c < 90; ++c)
                    if (distance(c) < distance(least)) least = c;
                wrong += found[at++] != least;
            }
    REQUIRE(wrong == 0);
}

TEST_CASE("the fit of labels finds the cells that made them", "[space]")
{
    const int count = 30;
    const WeightedPoints given = points_of(packed_spheres(cube(), count, 4));
    const WeightedCells cells = weighted_cells(given, cube());
    const VoxelGrid grid { { 20, 20, 20 }, { side / 20, side / 20, side / 20 }, {} };
    const std::vector<int> labels = cells_of_voxels(given, cells.complex, grid);
    LabelSamples samples = samples_of(labels, grid, count);
    LabelScores scores;
    const double radius = std::cbrt(0.75 * cube().volume / (pi * count));
    for (int i = 0; i < count; ++i) {  // centroids, and equal sizes
        const Vector c = cells.centroids[i];
        scores.centres.push_back(c);
        scores.slopes.push_back(c);
        scores.levels.push_back(dot(c, c));
    }
    const auto right = [&] {
        int number = 0;
        for (std::size_t v = 0; v < labels.size(); ++v) {
            int most = 0;
            for (int c = 1; c < count; ++c)
                if (scores.at(c, samples.points[v]) > scores.at(most, samples.points[v])) most = c;
            number += most == labels[v];
        }
        return static_cast<double>(number) / static_cast<double>(labels.size());
    };
    REQUIRE(right() < 0.9);
    for (const double part : { 1.0, 0.25, 0.0625 }) {
        const LabelFitOptions options { part * grid.size.x * radius, radius, 1e-6, 12 };
        scores = fit_labels(samples, scores, options);
    }
    REQUIRE(right() > 0.998);

    SECTION("scores that are far too sharp stay numbers, and come back")
    {
        for (int i = 0; i < count; ++i) {
            const Vector c = scores.centres[i];
            scores.slopes[i] = 1e12 * c;
            scores.levels[i] = 1e12 * dot(c, c);
        }
        const LabelFitOptions options { grid.size.x * radius, radius, 1e-6, 12 };
        scores = fit_labels(samples, scores, options);
        for (int i = 0; i < count; ++i)
            REQUIRE((is_finite(scores.slopes[i]) && std::isfinite(scores.levels[i])));
        REQUIRE(right() > 0.5);
    }

    SECTION("a label that rivals leave out is refused")
    {
        for (int& rival : samples.rivals)
            rival = rival == 3 ? 4 : rival;
        REQUIRE_THROWS_WITH(fit_labels(samples, scores, {}), Catch::Contains("rivals of label 3"));
    }
}
