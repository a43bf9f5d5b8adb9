// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Segments, and edges with their two corners.
#include <flexpm/kernel/geometry/overlap.hpp>

#include <flexpm/kernel/geometry/overlap_pair.hpp>

namespace flexpm {

void InPlane::Piece::start(double reach, double)
{
    from = -reach;
    to = reach;
}

bool InPlane::Piece::cut(double a, double b, double)
{
    if (b > 0.0)
        to = std::min(to, a / b);
    else if (b < 0.0)
        from = std::max(from, a / b);
    else if (a < 0.0)
        return false;
    return from < to;
}

double InPlane::Piece::largest(double a, double b, double) const
{
    return std::max(a - b * from, a - b * to);
}

std::array<double, 3> InPlane::Piece::moments() const
{
    return { size() * size() * size() / 12.0, 0.0, 0.0 };
}

ContactPlane InPlane::plane_of(const Vector* corners, int)
{
    const Vector along = corners[1] - corners[0];
    const double length = norm(along);
    const Vector normal { along.y / length, -along.x / length, 0.0 };
    return { normal, dot(normal, 0.5 * (corners[0] + corners[1])), true };
}

void InPlane::spread(const Vector* corners, int, const FaceForce& on, Vector* forces)
{
    const Vector along = corners[1] - corners[0];
    const double share = dot(on.point - corners[0], along) / dot(along, along);
    forces[0] = forces[0] + (1.0 - share) * on.force;
    forces[1] = forces[1] + share * on.force;
}

template class PairOverlap<InPlane>;

}  // namespace flexpm
