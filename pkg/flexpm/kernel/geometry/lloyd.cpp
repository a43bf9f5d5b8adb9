// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Lloyd's relaxation: each seed moves to the centroid of its power cell, and weights make
/// the areas equal. The cells are not made by power_diagram(), because that function needs a convex
/// outline and a grain is only star-shaped. Here each cell starts as the whole grain and every
/// other seed cuts it once. This works for any polygon and is quick for the few seeds of a grain.
#include <flexpm/kernel/geometry/lloyd.hpp>

#include <flexpm/kernel/geometry/polygon.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexpm {

namespace {

constexpr int most_rounds = 400;
constexpr double area_tolerance = 0.01;  // of the mean area

using InnerCell = std::vector<InnerCorner>;

std::vector<Point> points_of(const InnerCell& cell)
{
    std::vector<Point> points;
    for (const InnerCorner& c : cell)
        points.push_back(c.point);
    return points;
}

bool inside(const std::vector<Point>& polygon, Point p)
{
    bool in = false;
    for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
        const Point a = polygon[i], b = polygon[j];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y))
            in = !in;
    }
    return in;
}

/// Evenly spread points of a sequence without randomness (Roberts' generalised golden ratio).
std::vector<Point> first_seeds(const std::vector<Point>& polygon, int count)
{
    Point low = polygon.front(), high = low;
    for (Point p : polygon) {
        low = { std::min(low.x, p.x), std::min(low.y, p.y) };
        high = { std::max(high.x, p.x), std::max(high.y, p.y) };
    }
    std::vector<Point> seeds;
    for (int i = 1; static_cast<int>(seeds.size()) < count; ++i) {
        const double u = std::fmod(0.5 + 0.7548776662466927 * i, 1.0);
        const double v = std::fmod(0.5 + 0.5698402909980532 * i, 1.0);
        const Point p = { low.x + u * (high.x - low.x), low.y + v * (high.y - low.y) };
        if (inside(polygon, p)) seeds.push_back(p);
    }
    return seeds;
}

/// Cut a cell down to where `offset + slope . x` is not positive; beyond the new edge lies
/// `beyond`.
void clip(InnerCell& cell, Point slope, double offset, Beyond beyond, InnerCell& scratch)
{
    const auto value = [&](Point p) { return dot(slope, p) + offset; };
    scratch.clear();
    for (std::size_t i = 0; i < cell.size(); ++i) {
        const InnerCorner &a = cell[i], &b = cell[(i + 1) % cell.size()];
        const double fa = value(a.point), fb = value(b.point);
        if (fa <= 0.0) scratch.push_back(a);
        if ((fa <= 0.0) == (fb <= 0.0)) continue;
        const double t = fa / (fa - fb);
        scratch.push_back({ a.point + t * (b.point - a.point), fa <= 0.0 ? beyond : a.beyond });
    }
    cell.swap(scratch);
}

/// Power cells of the seeds inside the polygon.
void cut_cells(
    const std::vector<Point>& polygon, const std::vector<double>& weights, InnerPacking& packing)
{
    const int count = static_cast<int>(packing.seeds.size());
    InnerCell scratch;
    for (int i = 0; i < count; ++i) {
        InnerCell& cell = packing.cells[i];
        cell.clear();
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            cell.push_back({ polygon[k], { Beyond::Kind::edge, static_cast<int>(k) } });
        }
        const Point s = packing.seeds[i];
        for (int j = 0; j < count; ++j) {
            if (j == i) continue;
            const Point o = packing.seeds[j];
            // dot(s, s) - dot(o, o) would round otherwise
            const double offset =
                s.x * s.x + s.y * s.y - o.x * o.x - o.y * o.y + weights[j] - weights[i];
            clip(cell, 2.0 * (o - s), offset, { Beyond::Kind::seed, j }, scratch);
        }
    }
}

/// Derivative of a cell's area with its weight [-].
double growth(const InnerPacking& packing, int cell)
{
    double sum = 0.0;
    const InnerCell& c = packing.cells[cell];
    for (std::size_t k = 0; k < c.size(); ++k) {
        if (!c[k].beyond.is_seed()) continue;
        const Point a = c[k].point, b = c[(k + 1) % c.size()].point;
        const Point s = packing.seeds[cell], o = packing.seeds[c[k].beyond.index];
        sum += 0.5 * norm(b - a) / norm(o - s);
    }
    return sum;
}

bool has_empty_cell(const InnerPacking& packing)
{
    return std::any_of(packing.cells.begin(), packing.cells.end(),
        [](const InnerCell& cell) { return cell.size() < 3; });
}

}  // namespace

InnerPacking relax_seeds(const std::vector<Point>& polygon, int count)
{
    // about the centroid: differences of squared places keep their digits
    const PolygonShape shape = polygon_shape(polygon);
    std::vector<Point> local;
    for (Point p : polygon)
        local.push_back(p - shape.centroid);
    InnerPacking packing { first_seeds(local, count), std::vector<InnerCell>(count) };
    std::vector<double> weights(count, 0.0);
    const double mean = shape.area / count;
    double best = std::numeric_limits<double>::infinity();
    std::vector<Point> best_seeds = packing.seeds;
    std::vector<double> best_weights = weights;
    for (int round = 0; round < most_rounds; ++round) {
        cut_cells(local, weights, packing);
        double worst = 0.0, moved = 0.0;
        std::vector<Point> next = packing.seeds;
        const std::vector<double> used = weights;
        for (int i = 0; i < count; ++i) {
            const PolygonShape s = packing.cells[i].size() < 3
                ? PolygonShape {}
                : polygon_shape(points_of(packing.cells[i]));
            worst = std::max(worst, std::fabs(s.area / mean - 1.0));
            weights[i] += 0.5 * (mean - s.area) / std::max(growth(packing, i), 0.5);
            // an empty cell keeps its seed: its weight brings it back
            if (s.area > 0.0) next[i] = s.centroid;
            moved = std::max(moved, norm(next[i] - packing.seeds[i]));
        }
        if (worst < best) {
            best = worst;
            best_seeds = packing.seeds;
            best_weights = used;
        }
        if (worst < area_tolerance && moved < 0.01 * std::sqrt(mean)) break;
        packing.seeds = next;
    }
    cut_cells(local, weights, packing);
    if (has_empty_cell(packing)) {
        // few cells in a long polygon may swap their places for ever
        packing.seeds = best_seeds;
        cut_cells(local, best_weights, packing);
    }
    for (Point& p : packing.seeds)
        p = p + shape.centroid;
    for (InnerCell& cell : packing.cells) {
        for (InnerCorner& c : cell)
            c.point = c.point + shape.centroid;
    }
    return packing;
}

}  // namespace flexpm
