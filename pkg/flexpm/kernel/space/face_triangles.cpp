// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Each corner of a polygon is tried as the tip of a fan.
#include <flexpm/kernel/space/face_triangles.hpp>

#include <algorithm>

namespace flexpm {
namespace {

/// Square of the height over the longest edge.
double triangle_quality(Vector a, Vector b, Vector c)
{
    const Vector ab = b - a, ac = c - a, bc = c - b;
    const Vector twice_area = cross(ab, ac);
    const double longest = std::max({ dot(ab, ab), dot(ac, ac), dot(bc, bc) });
    return longest > 0.0 ? dot(twice_area, twice_area) / (longest * longest) : 0.0;
}

/// Quality of the worst triangle of the fan from each corner; 0 of a triangle.
std::vector<double> fan_qualities(
    const std::vector<Vector>& vertices, const std::vector<int>& corners)
{
    const std::size_t n = corners.size();
    const auto at = [&](std::size_t k) { return vertices[corners[k % n]]; };
    std::vector<double> qualities(n, 0.0);
    for (std::size_t from = 0; n > 3 && from < n; ++from) {
        qualities[from] = 1e300;
        for (std::size_t k = 1; k + 1 < n; ++k)
            qualities[from] = std::min(
                qualities[from], triangle_quality(at(from), at(from + k), at(from + k + 1)));
    }
    return qualities;
}

/// Triangles of a convex polygon whose worst one is as good as can be, for polygons with corners on
/// straight edges, where each fan may have a triangle without area.
class BestTriangles {
public:
    BestTriangles(const std::vector<Vector>& v, const std::vector<int>& c) :
        vertices(v),
        corners(c),
        size(c.size()),
        quality(size * size, 1e300),
        middle(size * size, 0)
    {
        for (std::size_t span = 2; span < size; ++span)
            for (std::size_t from = 0; from + span < size; ++from)
                choose(from, from + span);
    }

    std::vector<FaceTriangle> run()
    {
        add(0, size - 1);
        return found;
    }

private:
    const std::vector<Vector>& vertices;
    const std::vector<int>& corners;
    std::size_t size;
    std::vector<double> quality;      ///< of the worst triangle between corners [from][to]
    std::vector<std::size_t> middle;  ///< third corner of the triangle on the line between them
    std::vector<FaceTriangle> found;

    void choose(std::size_t from, std::size_t to)
    {
        double best = -1.0;
        for (std::size_t k = from + 1; k < to; ++k) {
            const double own = triangle_quality(
                vertices[corners[from]], vertices[corners[k]], vertices[corners[to]]);
            const double worst =
                std::min({ own, quality[from * size + k], quality[k * size + to] });
            if (worst <= best) continue;
            best = worst;
            middle[from * size + to] = k;
        }
        quality[from * size + to] = best;
    }

    void add(std::size_t from, std::size_t to)
    {
        if (to < from + 2) return;
        const std::size_t k = middle[from * size + to];
        found.push_back({ corners[from], corners[k], corners[to] });
        add(from, k);
        add(k, to);
    }
};

/// Square of height over length below which a triangle is a line.
constexpr double flat = 1e-12;

}  // namespace

std::vector<FaceTriangle> face_triangles(
    const std::vector<Vector>& vertices, const std::vector<int>& corners)
{
    const std::size_t n = corners.size();
    const auto at = [&](std::size_t k) { return corners[k % n]; };
    const std::vector<double> qualities = fan_qualities(vertices, corners);
    const auto best = static_cast<std::size_t>(
        std::max_element(qualities.begin(), qualities.end()) - qualities.begin());
    if (n > 3 && qualities[best] < flat) return BestTriangles(vertices, corners).run();
    std::vector<FaceTriangle> triangles;
    for (std::size_t k = 1; k + 1 < n; ++k)
        triangles.push_back({ at(best), at(best + k), at(best + k + 1) });
    return triangles;
}

void begin_alike(const std::vector<Vector>& vertices, std::vector<int>& corners)
{
    const std::vector<double> qualities = fan_qualities(vertices, corners);
    const double best = *std::max_element(qualities.begin(), qualities.end());
    std::size_t first = 0;
    for (std::size_t k = 0; k < corners.size(); ++k)
        if (qualities[k] == best && (qualities[first] < best || corners[k] < corners[first]))
            first = k;
    std::rotate(
        corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(first), corners.end());
}

double sharpest_cosine(Vector centre, Vector a, Vector b, Vector c)
{
    if (!(six_volumes(centre, a, b, c) > 0.0)) return 2.0;
    // outward normals of the four sides
    std::array<Vector, 4> normals = { cross(b - a, c - a), cross(b - centre, a - centre),
        cross(c - centre, b - centre), cross(a - centre, c - centre) };
    for (Vector& n : normals)
        n = (1.0 / norm(n)) * n;
    double sharpest = -1.0;
    for (int i = 0; i < 4; ++i)
        for (int j = i + 1; j < 4; ++j)
            sharpest = std::max(sharpest, -dot(normals[i], normals[j]));
    return sharpest;
}

}  // namespace flexpm
