// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/plane_lanes/bond_faces.hpp>

#include <algorithm>
#include <cmath>

namespace flexpm {

namespace {

constexpr double facing_slide = 0.5;                 // of an edge
constexpr double facing_turn = 0.52359877559829887;  // 30 degrees
constexpr double least_cosine = 0.5;                 // of 60 degrees
constexpr double deepest = 0.5;                      // of an edge: a face further behind the other

/// 0 up to a limit, 1 from twice that on.
double beyond(double value, double limit)
{
    return std::min(std::max(value / limit - 1.0, 0.0), 1.0);
}

/// Whether the second face looks to the first, and not from far behind it. Two that are opposed
/// have no mean.
bool is_before(const BondFaces& faces)
{
    if (!(faces.cosine() > least_cosine)) return false;
    const double length = 0.5 * norm(faces.along[0] + faces.along[1]);
    return dot(faces.apart(0.5, 0.5), faces.normal) > -deepest * length;
}

}  // namespace

Point BondFaces::apart(double share_a, double share_b) const
{
    return (start[1] + share_b * along[1]) - (start[0] + share_a * along[0]);
}

double BondFaces::slide() const
{
    const Point mean = 0.5 * (along[0] + along[1]);
    return std::fabs(dot(apart(0.5, 0.5), mean)) / dot(mean, mean);
}

double BondFaces::cosine() const
{
    return dot(along[0], along[1]) / (norm(along[0]) * norm(along[1]));
}

double BondFaces::turn() const { return std::acos(std::min(cosine(), 1.0)); }

BondFaces bond_faces(const Assembly& a, int contact)
{
    BondFaces faces {};
    for (int side = 0; side < 2; ++side) {
        const auto [from, to] = a.contacts.edge(contact, side);
        faces.start[side] = a.grains.point_at(from);
        faces.along[side] = a.grains.point_at(to) - faces.start[side];
    }
    const Point along = faces.along[0] + faces.along[1];
    const double length = norm(along);
    faces.normal = { along.y / length, -along.x / length };
    return faces;
}

double parting(const BondFaces& faces)
{
    if (!is_before(faces)) return 1.0;
    return std::max(beyond(faces.slide(), facing_slide), beyond(faces.turn(), facing_turn));
}

bool is_facing(const BondFaces& faces, double part)
{
    return is_before(faces) && faces.slide() <= part * facing_slide
        && faces.turn() <= part * facing_turn;
}

}  // namespace flexpm
