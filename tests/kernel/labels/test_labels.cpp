// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Power cells of weighted points, weights of given volumes, cells of voxels, and the fit of
/// labels.
#include <flexpm/kernel/labels/given_volumes.hpp>
#include <flexpm/kernel/labels/label_fit.hpp>
#include <flexpm/kernel/labels/label_guard.hpp>
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

namespace {

/// Voxels of the unit cube, all labels compete for each voxel.
LabelledGrid grid_of(std::array<int, 3> counts, std::vector<int> labels, int count)
{
    const VoxelGrid grid { counts, { 1.0, 1.0, 1.0 }, {} };
    LabelledGrid voxels { grid, std::move(labels), {}, {}, count };
    const LabelSamples samples = samples_of(voxels.labels, grid, count);
    voxels.rival_offsets = samples.rival_offsets;
    voxels.rivals = samples.rivals;
    return voxels;
}

/// Score of |x - p|^2 for each of some points.
LabelScores scores_of(const std::vector<Vector>& points)
{
    LabelScores scores;
    for (const Vector p : points) {
        scores.centres.push_back(p);
        scores.slopes.push_back(p);
        scores.levels.push_back(dot(p, p));
    }
    return scores;
}

/// Number of voxels of each label in which it has the largest score.
std::vector<int> own_voxels(const LabelledGrid& voxels, const LabelScores& scores)
{
    const LabelSamples samples = samples_of(voxels.labels, voxels.grid, scores.labels());
    std::vector<int> found(scores.labels(), 0);
    for (std::size_t v = 0; v < voxels.labels.size(); ++v) {
        int most = 0;
        for (int c = 1; c < scores.labels(); ++c)
            if (scores.at(c, samples.points[v]) > scores.at(most, samples.points[v])) most = c;
        if (most == voxels.labels[v]) ++found[most];
    }
    return found;
}

}  // namespace

TEST_CASE("a level rises by what its label lacks", "[space]")
{
    // points at 2 and 8: equal levels divide the row of ten voxels at 5, and a level higher by h
    // moves this place by h / 12
    const LabelledGrid voxels = grid_of({ 10, 1, 1 }, { 0, 0, 0, 0, 0, 0, 0, 1, 1, 1 }, 2);
    LabelScores scores = scores_of({ { 2.0, 0.5, 0.5 }, { 8.0, 0.5, 0.5 } });
    const double before = scores.levels[0];
    const RaisedLevels found = raise_levels(voxels, scores, { 7, 3 }, 10);
    REQUIRE(found.reached);
    REQUIRE(found.levels[0] - before == Approx(12.0 * 1.5).epsilon(1e-6));
    REQUIRE(found.levels[1] == scores.levels[1]);
    REQUIRE(raise_levels(voxels, scores, { 5, 3 }, 10).levels == scores.levels);
}

TEST_CASE("labels get their voxels by the least levels", "[space]")
{
    const int count = 12;
    Random random(5);
    std::vector<Vector> points;
    std::vector<double> lower;
    for (int i = 0; i < count; ++i) {
        points.push_back({ 9.0 * random.next(), 8.0 * random.next(), 7.0 * random.next() });
        lower.push_back(8.0 * random.next());
    }
    LabelScores scores = scores_of(points);
    LabelledGrid voxels = grid_of({ 9, 8, 7 }, std::vector<int>(504, 0), count);
    // labels of cells of other sizes, and a tenth of them drawn
    const LabelSamples samples = samples_of(voxels.labels, voxels.grid, count);
    for (std::size_t v = 0; v < voxels.labels.size(); ++v) {
        int most = static_cast<int>(count * random.next());
        for (int c = 0; c < count && v % 10 != 0; ++c)
            if (scores.at(c, samples.points[v]) > scores.at(most, samples.points[v])) most = c;
        voxels.labels[v] = most;
    }
    // what some levels reach can be reached
    const std::vector<int> least = own_voxels(voxels, scores);
    REQUIRE(*std::max_element(least.begin(), least.end()) > 10);
    for (int i = 0; i < count; ++i)
        scores.levels[i] -= lower[i];
    const RaisedLevels found = raise_levels(voxels, scores, least, 1000);
    REQUIRE(found.reached);
    LabelScores raised = scores;
    raised.levels = found.levels;
    const std::vector<int> own = own_voxels(voxels, raised);
    int number = 0;
    for (int i = 0; i < count; ++i) {
        CAPTURE(i);
        REQUIRE(own[i] >= least[i]);
        // and no level is higher than that it must be
        if (found.levels[i] == scores.levels[i]) continue;
        ++number;
        LabelScores less = raised;
        less.levels[i] -= 3e-6;
        REQUIRE(own_voxels(voxels, less)[i] < least[i]);
    }
    REQUIRE(number >= count / 2);
}

TEST_CASE("levels that no label can have end, and arrays of other sizes are refused", "[space]")
{
    // two labels that alternate: no half space has all voxels of one of them
    LabelledGrid voxels = grid_of({ 6, 1, 1 }, { 0, 1, 0, 1, 0, 1 }, 2);
    const LabelScores scores = scores_of({ { 1.0, 0.5, 0.5 }, { 5.0, 0.5, 0.5 } });
    REQUIRE_FALSE(raise_levels(voxels, scores, { 3, 3 }, 20).reached);
    REQUIRE_THROWS_WITH(raise_levels(voxels, scores, { 3 }, 20), Catch::Contains("start"));
    voxels.labels[3] = 2;
    REQUIRE_THROWS_WITH(raise_levels(voxels, scores, { 3, 3 }, 20), Catch::Contains("labels"));
    // labels that share their voxels do not compete
    voxels.labels[3] = 1;
    voxels.separate = 0;
    REQUIRE(raise_levels(voxels, scores, { 3, 3 }, 20).levels == scores.levels);
}
