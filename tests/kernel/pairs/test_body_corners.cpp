// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Corners of bodies that deform against those that are cut out face by face.
#include "support/catch.hpp"
#include "support/convex_bodies.hpp"

#include <flexpm/kernel/pairs/body_corners.hpp>

using namespace convex_bodies;

namespace {

/// Largest distance of a corner of one list from the nearest one of the other, both ways.
double distance(const std::vector<Vector>& one, const std::vector<Vector>& other)
{
    double largest = 0.0;
    for (const auto& [from, to] : { std::tie(one, other), std::tie(other, one) }) {
        for (const Vector at : from) {
            double least = 1e300;
            for (const Vector near : to)
                least = std::min(least, norm(at - near));
            largest = std::max(largest, least);
        }
    }
    return largest;
}

std::vector<Vector> cut_out(const std::vector<ContactPlane>& planes)
{
    std::vector<Vector> corners;
    SpaceOverlap().find_corners(planes.data(), static_cast<int>(planes.size()), corners);
    return corners;
}

/// Planes moved and turned by up to a part of the size 1 of their body.
std::vector<ContactPlane> deformed(std::vector<ContactPlane> planes, double part, Random& random)
{
    for (ContactPlane& p : planes) {
        p.offset += between(random, -part, part);
        const Vector normal = p.normal + between(random, 0.0, part) * direction<InSpace>(random);
        p.normal = (1.0 / norm(normal)) * normal;
    }
    return planes;
}

}  // namespace

TEST_CASE("Corners of bodies that deform are those that are cut out face by face", "[pairs]")
{
    Random random(5);
    std::vector<Vector> corners;
    for (int k = 0; k < 200; ++k) {
        std::vector<ContactPlane> planes;
        for (const Vector axis : { Vector { 1, 0, 0 }, Vector { 0, 1, 0 }, Vector { 0, 0, 1 } })
            for (const double sign : { -1.0, 1.0 })
                planes.push_back({ sign * axis, 1.0, true });
        for (int more = k % 10; more > 0; --more)
            planes.push_back({ direction<InSpace>(random), between(random, 0.8, 1.2), true });
        // four planes meet in a corner, and one more in another
        planes.push_back({ std::sqrt(0.5) * Vector { 1.0, 1.0, 0.0 }, std::sqrt(2.0), true });
        const std::vector<BodyCorner> known = corners_behind(planes);
        CHECK(known.size() >= cut_out(planes).size());
        for (const double part : { 0.0, 1e-4, 2e-3 }) {
            const std::vector<ContactPlane> now = deformed(planes, part, random);
            place_corners(now, known, corners);
            CHECK(distance(corners, cut_out(now)) < 1e-9);
        }
    }
}

TEST_CASE("Corners have one order, wherever they were found", "[pairs]")
{
    Random random(6);
    std::vector<ContactPlane> planes;
    for (int k = 0; k < 14; ++k)
        planes.push_back({ direction<InSpace>(random), between(random, 0.9, 1.0), true });
    const std::vector<ContactPlane> later = deformed(planes, 1e-3, random);
    std::vector<Vector> early, late;
    place_corners(later, corners_behind(planes), early);
    place_corners(later, corners_behind(later), late);
    REQUIRE(early.size() == late.size());
    for (std::size_t k = 0; k < early.size(); ++k)
        CHECK(norm(early[k] - late[k]) == 0.0);
}
