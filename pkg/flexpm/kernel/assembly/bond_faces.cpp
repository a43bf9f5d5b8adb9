// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/assembly/bond_faces.hpp>

#include <cmath>

namespace flexpm {

namespace {

constexpr double largest_slide = 0.5;                    // of an edge
constexpr double least_cosine = 0.86602540378443864676;  // of 30 degrees

}  // namespace

double BondFaces::opening(double share_a, double share_b) const
{
    return dot((start[1] + share_b * along[1]) - (start[0] + share_a * along[0]), normal);
}

double BondFaces::slide() const
{
    const Point mean = 0.5 * (along[0] + along[1]);
    const Point apart = (start[1] + 0.5 * along[1]) - (start[0] + 0.5 * along[0]);
    return std::fabs(dot(apart, mean)) / dot(mean, mean);
}

double BondFaces::cosine() const
{
    return dot(along[0], along[1]) / (norm(along[0]) * norm(along[1]));
}

BondFaces bond_faces(const Assembly& a, int contact)
{
    BondFaces faces {};
    for (int side = 0; side < 2; ++side) {
        const auto [from, to] = a.contacts.edge(contact, side);
        faces.start[side] = a.grains.position(from);
        faces.along[side] = a.grains.position(to) - faces.start[side];
    }
    const Point along = faces.along[0] + faces.along[1];
    const double length = norm(along);
    faces.normal = { along.y / length, -along.x / length };
    return faces;
}

bool is_facing(const BondFaces& faces)
{
    return faces.cosine() > least_cosine && faces.slide() < largest_slide;
}

}  // namespace flexpm
