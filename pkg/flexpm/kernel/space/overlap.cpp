// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Convex polygons, and faces with any number of corners.
#include <flexpm/kernel/space/overlap.hpp>

#include <flexpm/kernel/geometry/overlap_pair.hpp>

namespace flexpm {

namespace {

/// Twice the area vector of a face, and the mean of its corners.
std::array<Vector, 2> area_and_mean(const Vector* corners, int count)
{
    Vector twice, mean = corners[0];
    for (int k = 1; k < count; ++k)
        mean = mean + corners[k];
    for (int k = 1; k + 1 < count; ++k)
        twice = twice + cross(corners[k] - corners[0], corners[k + 1] - corners[0]);
    return { twice, (1.0 / count) * mean };
}

}  // namespace

void InSpace::Piece::reserve(int cuts)
{
    const std::size_t most = cuts + 4;  // each cut adds at most one corner
    if (value.size() < most) {
        value.resize(most);
        room.resize(2 * most);
    }
    now = room.data();
    next = now + value.size();
}

void InSpace::Piece::start(double along, double across)
{
    n = 4;
    now[0] = { -along, -across };
    now[1] = { along, -across };
    now[2] = { along, across };
    now[3] = { -along, across };
}

bool InSpace::Piece::cut(double a, double b, double c)
{
    const Corner* const from = now;
    double* const depth = value.data();
    int below = 0, last = 0;  // the last corner that goes
    for (int i = 0; i < n; ++i) {
        depth[i] = a - b * from[i].u - c * from[i].v;
        if (depth[i] < 0.0) {
            ++below;
            last = i;
        }
    }
    if (below == 0) return true;
    if (below == n) return false;
    // The corners that stay are one run: round-off that says otherwise is left out.
    if (last == n - 1 && depth[0] < 0.0) {
        last = 0;
        while (depth[last + 1] < 0.0)
            ++last;
    }
    Corner* to = next;
    const auto add_crossing = [&](int in, int out) {
        const double t = depth[in] / (depth[in] - depth[out]);
        *to++ = { from[in].u + t * (from[out].u - from[in].u),
            from[in].v + t * (from[out].v - from[in].v) };
    };
    int i = last + 1 == n ? 0 : last + 1, previous = last;
    add_crossing(i, last);
    while (depth[i] >= 0.0) {
        *to++ = from[i];
        previous = i;
        i = i + 1 == n ? 0 : i + 1;
    }
    add_crossing(previous, i);
    n = static_cast<int>(to - next);
    std::swap(now, next);
    return true;
}

double InSpace::Piece::largest(double a, double b, double c) const
{
    double most = a - b * now[0].u - c * now[0].v;
    for (int i = 1; i < n; ++i)
        most = std::max(most, a - b * now[i].u - c * now[i].v);
    return most;
}

double InSpace::Piece::size() const
{
    double twice = 0.0;
    for (int i = 1; i + 1 < n; ++i)
        twice += (now[i].u - now[0].u) * (now[i + 1].v - now[0].v)
            - (now[i + 1].u - now[0].u) * (now[i].v - now[0].v);
    return 0.5 * twice;
}

std::array<double, 2> InSpace::Piece::centre() const
{
    double twice = 0.0, along = 0.0, across = 0.0;
    for (int i = 1; i + 1 < n; ++i) {
        const double bu = now[i].u - now[0].u, bv = now[i].v - now[0].v;
        const double cu = now[i + 1].u - now[0].u, cv = now[i + 1].v - now[0].v;
        const double area = bu * cv - cu * bv;
        twice += area;
        along += area * (bu + cu);
        across += area * (bv + cv);
    }
    if (!(twice > 0.0)) return { now[0].u, now[0].v };
    return { now[0].u + along / (3.0 * twice), now[0].v + across / (3.0 * twice) };
}

std::array<double, 3> InSpace::Piece::moments() const
{
    // triangles from the centre to the edges
    const auto [u0, v0] = centre();
    std::array<double, 3> sum {};
    for (int i = 0; i < n; ++i) {
        const int k = i + 1 == n ? 0 : i + 1;
        const double bu = now[i].u - u0, bv = now[i].v - v0, cu = now[k].u - u0, cv = now[k].v - v0;
        const double area = (bu * cv - cu * bv) / 12.0;
        sum[0] += area * (bu * bu + bu * cu + cu * cu);
        sum[1] += area * (bu * bv + 0.5 * (bu * cv + cu * bv) + cu * cv);
        sum[2] += area * (bv * bv + bv * cv + cv * cv);
    }
    return sum;
}

std::array<Vector, 2> InSpace::tangents(Vector n)
{
    // Duff et al. 2017, "Building an orthonormal basis, revisited": no branch, no root
    const double sign = std::copysign(1.0, n.z), a = -1.0 / (sign + n.z), b = n.x * n.y * a;
    return { Vector { 1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x },
        Vector { b, sign + n.y * n.y * a, -n.y } };
}

ContactPlane InSpace::plane_of(const Vector* corners, int count)
{
    const auto [twice, mean] = area_and_mean(corners, count);
    const Vector normal = (1.0 / norm(twice)) * twice;
    return { normal, dot(normal, mean), true };
}

void InSpace::spread(const Vector* corners, int count, const FaceForce& on, Vector* forces)
{
    const auto [twice, mean] = area_and_mean(corners, count);
    // The plane's normal turns by the change of the area vector S = 1/2 sum x_k x x_(k+1) across
    // the normal, over |S|.
    const double squared = dot(twice, twice), along = dot(on.force, twice) / squared;
    const Vector offset = mean - on.point;
    const Vector arm = along * (offset - (dot(offset, twice) / squared) * twice);
    for (int k = 0; k < count; ++k) {
        const Vector past = corners[(k + 1) % count] - corners[(k + count - 1) % count];
        forces[k] = forces[k] + (1.0 / count) * on.force + cross(past, arm);
    }
}

template class PairOverlap<InSpace>;

}  // namespace flexpm
