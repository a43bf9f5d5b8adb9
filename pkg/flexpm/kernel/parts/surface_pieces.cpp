// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/parts/surface_pieces.hpp>

#include <flexpm/kernel/space_lanes/solid_access.hpp>

namespace flexpm {

namespace {

/// Share of a triangle that is none [-].
constexpr double no_share = 1e-12;

/// Place in a triangle: weights of its corners.
using Weights = std::array<double, 3>;

Vector at(const std::array<Vector, 3>& corners, const Weights& w)
{
    return w[0] * corners[0] + w[1] * corners[1] + w[2] * corners[2];
}

/// Part of a polygon in which a value of its corners is not above 0.
template <class Value>
std::vector<Weights> kept_of(const std::vector<Weights>& polygon, Value value)
{
    std::vector<Weights> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Weights &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double of_a = value(a), of_b = value(b);
        if (of_a <= 0.0) kept.push_back(a);
        if ((of_a < 0.0 && of_b > 0.0) || (of_a > 0.0 && of_b < 0.0)) {
            const double part = of_a / (of_a - of_b);
            Weights crossing;
            for (int k = 0; k < 3; ++k)
                crossing[k] = a[k] + part * (b[k] - a[k]);
            kept.push_back(crossing);
        }
    }
    return kept;
}

}  // namespace

bool faces(const Plate& plate, Vector outwards)
{
    constexpr double least = 0.5;
    return -dot(plate.normal, outwards) > least * norm(outwards);
}

Piece piece_of(const SolidState& s, int triangle, const std::vector<HalfSpace>& within)
{
    std::array<Vector, 3> corners;
    for (int k = 0; k < 3; ++k)
        corners[k] = space_vector(s.grains.reference, s.surface.nodes[triangle][k]);
    std::vector<Weights> polygon { { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 } };
    for (const HalfSpace& half : within)
        polygon = kept_of(polygon,
            [&](const Weights& w) { return dot(half.normal, at(corners, w)) - half.most; });
    Piece piece;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
        const Weights &p = polygon[0], &q = polygon[i], &r = polygon[i + 1];
        // a triangle of weights has this share of the whole one
        const double share = (q[1] - p[1]) * (r[2] - p[2]) - (q[2] - p[2]) * (r[1] - p[1]);
        piece.share += share;
        for (int k = 0; k < 3; ++k)
            piece.middle[k] += share / 3.0 * (p[k] + q[k] + r[k]);
    }
    if (!(piece.share > no_share)) return {};
    for (double& weight : piece.middle)
        weight /= piece.share;
    piece.place = at(corners, piece.middle);
    return piece;
}

void set_gaps(Plate& plate, double nearest, double none)
{
    for (PlatePoint& point : plate.points)
        point.gap = point.opening = point.gap - nearest < none ? 0.0 : point.gap - nearest;
}

void add_touch(const SolidState& s, Plate& plate, int triangle, const Piece& piece)
{
    PlatePoint point;
    point.facet = triangle;
    point.weights = piece.middle;
    point.area = piece.share * norm(area_vector(s, triangle));
    point.normal = plate.normal;
    plate.points.push_back(point);
}

}  // namespace flexpm
