// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Points of faces against closed forms and against the moments of random polygons.
#include <flexpm/kernel/space/face_points.hpp>
#include <flexpm/kernel/space/face_triangles.hpp>

#include "space/face_moments.hpp"

using namespace flexpm_test;

namespace {

const std::vector<FacePointRule> exact_rules = { FacePointRule::corners_and_inner,
    FacePointRule::three, FacePointRule::four };

/// A convex polygon in a random plane: corners on an ellipse at random angles.
std::vector<Vector> random_polygon(Random& random, int corners)
{
    std::vector<double> angles(corners);
    for (double& a : angles)
        a = 2.0 * pi * random.next();
    std::sort(angles.begin(), angles.end());
    const Rotation rotation = random_rotation(random);
    const double wide = 1e-3 * (0.5 + random.next()), high = 1e-3 * (0.5 + random.next());
    std::vector<Vector> result;
    for (double a : angles)
        result.push_back(turned(rotation, { wide * std::cos(a), high * std::sin(a), 2e-3 }));
    return result;
}

}  // namespace

TEST_CASE("points of triangles and parallelograms have the weights of the closed forms", "[space]")
{
    const std::vector<Vector> triangle = { { 0, 0, 0 }, { 3, 0, 1 }, { 1, 2, 0 } };
    const std::vector<Vector> parallelogram = { { 0, 0, 0 }, { 2, 0, 1 }, { 3, 1, 1 },
        { 1, 1, 0 } };
    for (const auto& corners : { triangle, parallelogram }) {
        const FacePoints found = face_points(corners, FacePointRule::corners_and_inner);
        const std::size_t n = corners.size();
        CHECK_FALSE(found.fallback);
        CHECK(found.area == Approx(norm(area_of(corners))).epsilon(1e-14));
        REQUIRE(found.points.size() == n + 1);
        for (std::size_t k = 0; k < n; ++k)
            CHECK(found.points[k].area == Approx(found.area / 12.0).epsilon(1e-12));
        CHECK(found.points[n].area
            == Approx(found.area * (n == 3 ? 3.0 / 4.0 : 2.0 / 3.0)).epsilon(1e-12));
        // two elements of the parallelogram meet at each end of one diagonal
        for (std::size_t k = 0; k < n; ++k) {
            const double share = found.points[n].shares[k];
            const double expected = n == 3 ? 1.0 / 3.0 : (share > 0.25 ? 3.0 : 1.0) / 8.0;
            CHECK(share == Approx(expected).epsilon(1e-12));
        }
    }
}

TEST_CASE("rules of face points are exact to their degree on convex polygons", "[space]")
{
    Random random(11);
    for (int draw = 0; draw < 300; ++draw) {
        const auto corners = random_polygon(random, 3 + draw % 7);
        for (FacePointRule rule : exact_rules)
            require_exact(corners, face_points(corners, rule), 2);
        require_exact(corners, face_points(corners, FacePointRule::one), 1);
        require_exact(corners, face_points(corners, FacePointRule::corners), 1);
        CHECK(face_points(corners, FacePointRule::one).points.size() == 1);
        CHECK(face_points(corners, FacePointRule::corners).points.size() == corners.size());
    }
}

TEST_CASE("corners alone are too stiff against bending, one point is not stiff", "[space]")
{
    const std::vector<Vector> square = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } };
    const auto moment = [&](FacePointRule rule) {
        double sum = 0.0;
        for (const FacePoint& p : face_points(square, rule).points) {
            const double y = point_of(square, p).y - 0.5;
            sum += p.area * y * y;
        }
        return sum;
    };
    CHECK(moment(FacePointRule::corners) == Approx(3.0 / 12.0));
    CHECK(moment(FacePointRule::one) == Approx(0.0).margin(1e-30));
    CHECK(moment(FacePointRule::corners_and_inner) == Approx(1.0 / 12.0));
}

TEST_CASE("regular faces have the weights of the closed forms, with noise too", "[space]")
{
    Random random(11);
    const auto check = [&](std::vector<Vector> corners, double corner, double close) {
        const FacePoints found = face_points(corners, FacePointRule::corners_and_inner);
        REQUIRE_FALSE(found.fallback);
        require_exact(corners, found, 2);
        for (std::size_t k = 0; k < corners.size(); ++k)
            CHECK(found.points[k].area / found.area == Approx(corner).margin(close));
    };
    for (const double noise : { 0.0, 1e-15, 1e-12, 1e-9, 1e-8, 1e-7, 1e-6, 1e-4, 1e-3 }) {
        for (int draw = 0; draw < 10; ++draw) {
            const auto shaken = [&](std::vector<Vector> corners) {
                for (Vector& c : corners) {
                    const double x = random.next(), y = random.next();
                    c = c + noise * Vector { x, y, 0.0 };
                }
                return corners;
            };
            const double close = 1e-12 + 10.0 * noise;
            check(shaken({ { 0, 0, 0 }, { 1, 0, 0 }, { 0.3, 0.9, 0 } }), 1.0 / 12.0, close);
            check(
                shaken({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } }), 1.0 / 12.0, close);
            check(
                shaken({ { 0, 0, 0 }, { 2, 0, 0 }, { 2, 1, 0 }, { 0, 1, 0 } }), 1.0 / 12.0, close);
            check(shaken({ { 0, 0, 0 }, { 1, 0, 0 }, { 1.5, 1, 0 }, { 0.5, 1, 0 } }), 1.0 / 12.0,
                close);
        }
    }
}

TEST_CASE("a uniform traction puts on each corner what the elements there ask for", "[space]")
{
    Random random(12);
    for (int draw = 0; draw < 300; ++draw) {
        const auto corners = random_polygon(random, 3 + draw % 6);
        std::vector<int> all;
        for (std::size_t k = 0; k < corners.size(); ++k)
            all.push_back(static_cast<int>(k));
        for (const auto rule : { FacePointRule::corners_and_inner, FacePointRule::one,
                 FacePointRule::three, FacePointRule::four, FacePointRule::corners }) {
            const FacePoints found = face_points(corners, rule);
            std::vector<double> loads(corners.size(), 0.0);
            for (const auto& [a, b, c] : face_triangles(corners, all)) {
                const double third =
                    dot(found.normal, cross(corners[b] - corners[a], corners[c] - corners[a]))
                    / 6.0;
                for (int k : { a, b, c })
                    loads[k] += third;
            }
            for (std::size_t k = 0; k < corners.size(); ++k) {
                double load = 0.0;
                for (const FacePoint& p : found.points)
                    load += p.area * p.shares[k];
                REQUIRE(std::abs(load - loads[k]) < 1e-12 * found.area);
            }
        }
    }
}

TEST_CASE("a face without a rule of corners and one point has equal ones, which is told", "[space]")
{
    std::vector<Vector> found_in;
    Random random(5);
    for (int draw = 0; draw < 20000 && found_in.empty(); ++draw) {
        auto corners = random_polygon(random, 4 + draw % 5);
        if (face_points(corners, FacePointRule::corners_and_inner).fallback) found_in = corners;
    }
    REQUIRE_FALSE(found_in.empty());
    const FacePoints points = face_points(found_in, FacePointRule::corners_and_inner);
    CHECK(points.points.size() == found_in.size() + 1);
    require_exact(found_in, points, 2);
}

TEST_CASE("faces without corners or area are refused", "[space]")
{
    CHECK_THROWS_WITH(face_points({ { 0, 0, 0 }, { 1, 0, 0 } }, FacePointRule::one),
        Catch::Contains("corners = 2"));
    CHECK_THROWS_WITH(face_points({ { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 } }, FacePointRule::one),
        Catch::Contains("area = 0 m^2"));
}
