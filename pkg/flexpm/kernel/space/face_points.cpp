// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Moments of a polygon in its plane, and weights that reproduce them.
#include <flexpm/kernel/space/face_points.hpp>

#include <flexpm/kernel/space/face_triangles.hpp>

#include <algorithm>
#include <array>
#include <numeric>

namespace flexpm {
namespace {

/// Second moments: xx, xy, yy.
using Moments = std::array<double, 3>;

constexpr int most_iterations = 50;
/// Residual of the second moments, of a face of area 1, at which weights are exact.
constexpr double exact = 1e-14;

Moments moments_of(Point p) { return { p.x * p.x, p.x * p.y, p.y * p.y }; }

void add(Moments& sum, double factor, const Moments& other)
{
    for (int k = 0; k < 3; ++k)
        sum[k] += factor * other[k];
}

/// The polygon in its plane, about its centroid, scaled to area 1.
struct PlaneFace {
    double area = 0.0;
    Vector normal;
    std::vector<Point> corners;
    Moments second {};          ///< of the area
    std::vector<double> loads;  ///< per corner: what a uniform traction puts on it
};

/// A point and its share of the area.
struct PlanePoint {
    Point place;
    double weight;
};

PlaneFace plane_face(const std::vector<Vector>& corners)
{
    const std::size_t n = corners.size();
    if (n < 3) {
        refuse("face_points: corners", static_cast<double>(n), "", "must be >= 3; give a polygon");
    }
    Vector twice;
    for (std::size_t k = 1; k + 1 < n; ++k)
        twice = twice + cross(corners[k] - corners[0], corners[k + 1] - corners[0]);
    PlaneFace face;
    face.area = 0.5 * norm(twice);
    check_positive("face_points: area", face.area, "m^2");
    face.normal = (0.5 / face.area) * twice;
    // the first axis along the longest edge, so that it follows the face when that turns
    Vector along;
    for (std::size_t k = 0; k < n; ++k) {
        const Vector edge = corners[(k + 1) % n] - corners[k];
        const Vector flat = edge - dot(edge, face.normal) * face.normal;
        if (dot(flat, flat) > dot(along, along)) along = flat;
    }
    const Vector first = (1.0 / norm(along)) * along, second = cross(face.normal, first);
    const double size = std::sqrt(face.area);
    for (const Vector& c : corners) {
        const Vector from = (1.0 / size) * (c - corners[0]);
        face.corners.push_back({ dot(from, first), dot(from, second) });
    }
    Point centroid;
    for (std::size_t k = 1; k + 1 < n; ++k) {
        const Point a = face.corners[k], b = face.corners[k + 1];
        centroid = centroid + (cross(a, b) / 6.0) * (a + b);
    }
    for (Point& p : face.corners)
        p = p - centroid;
    for (std::size_t k = 0; k < n; ++k) {
        const Point a = face.corners[k], b = face.corners[(k + 1) % n];
        const double factor = cross(a, b) / 24.0;
        add(face.second, factor, moments_of(a));
        add(face.second, factor, moments_of(b));
        add(face.second, factor, moments_of(a + b));
    }
    // a third of each of the triangles that the grains' elements have there
    face.loads.assign(n, 0.0);
    std::vector<int> all(n);
    std::iota(all.begin(), all.end(), 0);
    for (const FaceTriangle& t : face_triangles(corners, all)) {
        const Point a = face.corners[t[0]], b = face.corners[t[1]], c = face.corners[t[2]];
        for (int k : t)
            face.loads[k] += cross(b - a, c - a) / 6.0;
    }
    return face;
}

/// Whether a point is inside or, to round-off, on the rim of a face, which may be concave.
bool is_inside(const PlaneFace& face, Point p)
{
    constexpr double rounding = 1e-9;
    const std::size_t n = face.corners.size();
    bool left_of_all = true, inside = false;
    for (std::size_t k = 0; k < n; ++k) {
        const Point a = face.corners[k], b = face.corners[(k + 1) % n];
        left_of_all = left_of_all && cross(b - a, p - a) >= -rounding * norm(b - a);
        if ((a.y > p.y) == (b.y > p.y)) continue;
        if ((cross(b - a, p - a) > 0.0) == (b.y > a.y)) inside = !inside;
    }
    return left_of_all || inside;
}

/// Equal points on sqrt(2) times the ellipse of inertia: exact to degree 2 for three and more,
/// wherever the first of them is. The ellipse is inside of convex faces; on others the points are
/// turned until they are inside, and there are none if they never are.
std::vector<PlanePoint> equal_points(const PlaneFace& face, int count)
{
    constexpr int turns = 16;
    const double xx = std::sqrt(face.second[0]), xy = face.second[1] / xx;
    const double yy = std::sqrt(std::max(face.second[2] - xy * xy, 0.0));
    std::vector<PlanePoint> points(count);
    for (int turn = 0; turn < turns; ++turn) {
        bool inside = true;
        for (int k = 0; k < count; ++k) {
            const double angle = 2.0 * pi * (k + static_cast<double>(turn) / turns) / count;
            const double c = std::sqrt(2.0) * std::cos(angle), s = std::sqrt(2.0) * std::sin(angle);
            points[k] = { { xx * c, xy * c + yy * s }, 1.0 / count };
            inside = inside && is_inside(face, points[k].place);
        }
        if (inside) return points;
    }
    return {};
}

/// Shares of the corners in a place: those of least deviation from `nearly`, whose sum is 1, with
/// the sum 1 and the place as their mean.
std::vector<double> shares_of(const PlaneFace& face, Point p, const std::vector<double>& nearly)
{
    const std::size_t n = face.corners.size();
    // about the mean of the corners, so that the sum is 1 whatever the multipliers are
    Point mean, now;
    for (std::size_t k = 0; k < n; ++k) {
        mean = mean + (1.0 / static_cast<double>(n)) * face.corners[k];
        now = now + nearly[k] * face.corners[k];
    }
    Moments m {};
    for (Point c : face.corners)
        add(m, 1.0, moments_of(c - mean));
    const Point to = p - now;
    const double det = m[0] * m[2] - m[1] * m[1];
    const Point multiplier { (m[2] * to.x - m[1] * to.y) / det, (m[0] * to.y - m[1] * to.x) / det };
    std::vector<double> shares;
    for (std::size_t k = 0; k < n; ++k)
        shares.push_back(nearly[k] + dot(multiplier, face.corners[k] - mean));
    return shares;
}

/// Shares of the corners in all points of a rule, so that a uniform traction puts on each corner
/// what it puts on the elements there: grains under uniform stress stay so at their contacts.
std::vector<std::vector<double>> shares_of(
    const PlaneFace& face, const std::vector<PlanePoint>& points)
{
    const std::size_t n = face.corners.size();
    // what points in the corners leave for the others
    std::vector<double> left = face.loads;
    std::vector<bool> is_corner;
    double weight = 1.0;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const Point at = points[k].place;
        is_corner.push_back(k < n && at.x == face.corners[k].x && at.y == face.corners[k].y);
        if (!is_corner[k]) continue;
        left[k] -= points[k].weight;
        weight -= points[k].weight;
    }
    for (double& l : left)
        l /= weight;
    std::vector<std::vector<double>> shares;
    for (std::size_t k = 0; k < points.size(); ++k) {
        if (is_corner[k]) {
            shares.emplace_back(n, 0.0);
            shares.back()[k] = 1.0;
        } else {
            shares.push_back(shares_of(face, points[k].place, left));
        }
    }
    return shares;
}

/// Points in the corners alone, with what a uniform traction puts on them.
std::vector<PlanePoint> corner_points(const PlaneFace& face)
{
    std::vector<PlanePoint> points;
    for (std::size_t k = 0; k < face.corners.size(); ++k)
        points.push_back({ face.corners[k], face.loads[k] });
    return points;
}

/// Solve for a symmetric matrix of three rows, none of whose eigenvalues is below zero, in place of
/// the right side. Rows that say the same as others count once: the moments xx and yy of the
/// corners of a square are one number.
void solve(std::array<std::array<double, 3>, 3> m, Moments& right)
{
    constexpr double rounding = 1e-14;
    const double same = rounding * std::max({ m[0][0], m[1][1], m[2][2] });
    std::array<bool, 3> counts {};
    for (int i = 0; i < 3; ++i) {
        int pivot = i;
        for (int k = i + 1; k < 3; ++k)
            if (std::abs(m[k][i]) > std::abs(m[pivot][i])) pivot = k;
        std::swap(m[i], m[pivot]);
        std::swap(right[i], right[pivot]);
        counts[i] = std::abs(m[i][i]) > same;
        for (int k = i + 1; counts[i] && k < 3; ++k) {
            const double factor = m[k][i] / m[i][i];
            for (int l = i; l < 3; ++l)
                m[k][l] -= factor * m[i][l];
            right[k] -= factor * right[i];
        }
    }
    for (int i = 2; i >= 0; --i) {
        for (int l = i + 1; l < 3; ++l)
            right[i] -= m[i][l] * right[l];
        right[i] = counts[i] ? right[i] / m[i][i] : 0.0;
    }
}

/// The point that takes what the corners leave: of the area and of the first moments.
PlanePoint inner_point(const std::vector<PlanePoint>& corners)
{
    double weight = 1.0;
    Point moment;
    for (const PlanePoint& p : corners) {
        weight -= p.weight;
        moment = moment - p.weight * p.place;
    }
    return { (1.0 / weight) * moment, weight };
}

/// Corners and one inner point, exact to degree 2: Gauss-Newton from weights that suit regular
/// polygons, with the least change of them; empty if there is no such rule inside the face.
std::vector<PlanePoint> corners_and_inner(const PlaneFace& face)
{
    const std::size_t n = face.corners.size();
    std::vector<PlanePoint> points(n);
    std::vector<double> start(n);
    for (std::size_t k = 0; k < n; ++k)
        points[k].place = face.corners[k];
    for (std::size_t k = 0; k < n; ++k) {
        const double share = cross(face.corners[k], face.corners[(k + 1) % n]) / 24.0;
        start[k] += share;
        start[(k + 1) % n] += share;
    }
    for (std::size_t k = 0; k < n; ++k)
        points[k].weight = start[k];
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
        const PlanePoint inner = inner_point(points);
        Moments missing = face.second;
        add(missing, -inner.weight, moments_of(inner.place));
        std::array<std::array<double, 3>, 3> matrix {};
        for (std::size_t k = 0; k < n; ++k) {
            add(missing, -points[k].weight, moments_of(points[k].place));
            // derivative of the moments by the weight of a corner
            const Moments by = moments_of(points[k].place - inner.place);
            for (int i = 0; i < 3; ++i)
                add(matrix[i], start[k] * by[i], by);
        }
        double residual = 0.0;
        for (double m : missing)
            residual = std::max(residual, std::abs(m));
        if (residual < exact) {
            points.push_back(inner);
            break;
        }
        solve(matrix, missing);
        for (std::size_t k = 0; k < n; ++k) {
            const Moments by = moments_of(points[k].place - inner.place);
            points[k].weight +=
                start[k] * (by[0] * missing[0] + by[1] * missing[1] + by[2] * missing[2]);
        }
    }
    if (points.size() == n || !is_inside(face, points.back().place)) return {};
    for (const PlanePoint& p : points)
        if (!(p.weight > 0.0)) return {};
    return points;
}

}  // namespace

bool has_points(const std::vector<Vector>& corners)
{
    try {
        face_points(corners, FacePointRule::corners_and_inner);
    } catch (const std::invalid_argument&) {
        return false;
    }
    return true;
}

FacePoints face_points(const std::vector<Vector>& corners, FacePointRule rule)
{
    const PlaneFace face = plane_face(corners);
    const int n = static_cast<int>(corners.size());
    std::vector<PlanePoint> places;
    switch (rule) {
    case FacePointRule::one:
        places = { { {}, 1.0 } };
        break;
    case FacePointRule::three:
        places = equal_points(face, 3);
        break;
    case FacePointRule::four:
        places = equal_points(face, 4);
        break;
    case FacePointRule::corners:
        places = corner_points(face);
        break;
    case FacePointRule::corners_and_inner:
        places = corners_and_inner(face);
        break;
    }
    const bool equal = rule == FacePointRule::three || rule == FacePointRule::four;
    FacePoints result { face.area, face.normal, places.empty(), {} };
    if (result.fallback) places = equal ? corners_and_inner(face) : equal_points(face, n + 1);
    if (places.empty()) {
        refuse("face_points: corners", static_cast<double>(n), "",
            "must bound a face with space for its contact points; move the adjacent spheres");
    }
    auto shares = shares_of(face, places);
    for (std::size_t k = 0; k < places.size(); ++k)
        result.points.push_back({ places[k].weight * face.area, std::move(shares[k]) });
    return result;
}

}  // namespace flexpm
