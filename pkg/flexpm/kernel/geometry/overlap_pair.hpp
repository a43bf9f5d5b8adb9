// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  How the overlap of a pair is integrated, for both dimensions: included where PairOverlap
/// is compiled.
///
/// The overlap is never built. The part R_f of it that is nearest to a counted plane f is bounded
/// by its ridges d_f = d_g towards other counted planes g, by walls, and by f. Each of these is a
/// polygon (a segment in 2D) in a known plane, cut by all other conditions, alone: no topology can
/// fail. A cone from a point of f over each of them adds to volume, moment and energy of R_f in
/// closed form; cones over the face of R_f in f have no height, and its area follows from the
/// sum of area vectors, which is 0.
#pragma once

#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/core/simd.hpp>
#include <flexpm/kernel/geometry/overlap.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexpm {

namespace overlap_detail {

constexpr double infinite = std::numeric_limits<double>::infinity();
/// Planes are equal, and a clearance leaves no overlap, up to this part of the size of a pair.
constexpr double round_off = 1e-13, birth_margin = 1e-12;

}  // namespace overlap_detail

/// True if a plane of the first body, or of the second one after all of those, has all points of the
/// other body well outside, so that round-off does not decide.
inline bool is_separating(const ContactBody& a, const ContactBody& b, double clearance, int face)
{
    if (face < 0 || face >= a.faces + b.faces || clearance < 0.0) return false;
    const bool of_a = face < a.faces;
    const ContactBody &own = of_a ? a : b, &other = of_a ? b : a;
    const ContactPlane& p = own.planes[of_a ? face : face - a.faces];
    const double distance = dot(p.normal, other.centre - own.centre);
    double least = overlap_detail::infinite;
    for (int i = 0; i < other.count; ++i)
        least = std::min(least, dot(p.normal, other.points[i]));
    const double offset = p.offset - (p.counted ? clearance : 0.0);
    return other.count > 0
        && offset - (least + distance)
        < -overlap_detail::birth_margin * (std::abs(offset) + std::abs(distance));
}

/// Planes and points of a body in the frame of the pair.
template <class Geometry>
void PairOverlap<Geometry>::load(const ContactBody& body, Vector from, double clearance, int which)
{
    shift[which] = from;
    planes[which].assign(body.planes, body.planes + body.faces);
    for (ContactPlane& p : planes[which])
        p.offset -= p.counted ? clearance : 0.0;
    const Vector* points = body.points;
    int count = body.count;
    // planes that move outwards leave the given points behind: those of a larger body of the same
    // shape contain it
    double larger = 1.0;
    for (int f = 0; f < body.faces && clearance < 0.0; ++f)
        if (body.planes[f].counted)
            larger = std::max(larger, planes[which][f].offset / body.planes[f].offset);
    const bool has_centre = std::all_of(body.planes, body.planes + body.faces,
        [](const ContactPlane& p) { return p.offset > 0.0; });
    if (count == 0 || (clearance < 0.0 && !has_centre)) {
        find_corners(planes[which].data(), body.faces, own_corners);
        points = own_corners.data();
        count = static_cast<int>(own_corners.size());
        larger = 1.0;
    }
    for (ContactPlane& p : planes[which])
        p.offset += dot(p.normal, from);
    number[which] = count;
    const int padded = (count + 3) / 4 * 4;
    x[which].resize(padded);
    y[which].resize(padded);
    z[which].resize(padded);
    for (int i = 0; i < padded; ++i) {
        const Vector at = larger * points[std::min(i, count - 1)] + from;
        x[which][i] = at.x;
        y[which][i] = at.y;
        z[which][i] = at.z;
    }
}

template <class Geometry>
void PairOverlap<Geometry>::find_corners(
    const ContactPlane* p, int faces, std::vector<Vector>& corners)
{
    double size = 0.0;
    for (int f = 0; f < faces; ++f)
        size = std::max(size, std::abs(p[f].offset));
    corners.clear();
    piece.reserve(faces);
    for (int f = 0; f < faces; ++f) {
        // The face is cut out of its plane by all others. No body is longer than the start.
        const auto [first, second] = Geometry::tangents(p[f].normal);
        const Vector origin = p[f].offset * p[f].normal;
        piece.start(100.0 * size, 100.0 * size);
        bool left = true;
        for (int k = 0; k < faces && left; ++k) {
            if (k == f) continue;
            left = piece.cut(p[k].offset - dot(p[k].normal, origin), dot(p[k].normal, first),
                dot(p[k].normal, second));
        }
        for (int i = 0; left && i < piece.corners(); ++i) {
            const std::array<double, 2> at = piece.corner(i);
            const Vector corner = origin + at[0] * first + at[1] * second;
            // a corner belongs to the first of its planes
            const bool is_known = std::any_of(p, p + f, [&](const ContactPlane& of) {
                return std::abs(of.offset - dot(of.normal, corner))
                    <= overlap_detail::round_off * size;
            });
            if (!is_known) corners.push_back(corner);
        }
    }
}

/// Least of normal . x over the points of a body: the offset of a plane minus this is the depth to
/// which the points enter.
template <class Geometry> double PairOverlap<Geometry>::lowest_over(int plane, int which) const
{
    const Vector n = planes[1 - which][plane].normal;
    const double *px = x[which].data(), *py = y[which].data(), *pz = z[which].data();
    const int padded = static_cast<int>(x[which].size());
    const auto two = [](const double* at) { return *reinterpret_cast<const Two*>(at); };
    constexpr double infinite = overlap_detail::infinite;
    Two even { infinite, infinite }, odd { infinite, infinite };
    for (int i = 0; i < padded; i += 4) {
        const Two one = n.x * two(px + i) + n.y * two(py + i) + n.z * two(pz + i);
        const Two other = n.x * two(px + i + 2) + n.y * two(py + i + 2) + n.z * two(pz + i + 2);
        even = one < even ? one : even;
        odd = other < odd ? other : odd;
    }
    even = odd < even ? odd : even;
    return std::min(even[0], even[1]);
}

/// Bounds, along the axes of the box, of the part of a body that lies below a plane of the other.
template <class Geometry>
void PairOverlap<Geometry>::extend(int which, int plane, std::array<double, 6>& bounds)
{
    const ContactPlane& p = planes[1 - which][plane];
    inside.clear();
    outside.clear();
    std::array<double, 6> own { overlap_detail::infinite, -overlap_detail::infinite,
        overlap_detail::infinite, -overlap_detail::infinite, overlap_detail::infinite,
        -overlap_detail::infinite };
    const auto include = [&own](double e0, double e1, double e2) {
        own = { std::min(own[0], e0), std::max(own[1], e0), std::min(own[2], e1),
            std::max(own[3], e1), std::min(own[4], e2), std::max(own[5], e2) };
    };
    for (int i = 0; i < number[which]; ++i) {
        const Vector at { x[which][i], y[which][i], z[which][i] };
        const std::array<double, 4> row { p.offset - dot(p.normal, at), dot(box.axes[0], at),
            dot(box.axes[1], at), dot(box.axes[2], at) };
        if (row[0] >= 0.0) {
            include(row[1], row[2], row[3]);
            inside.push_back(row);
        } else {
            outside.push_back(row);
        }
    }
    for (const std::array<double, 4>& i : inside) {
        for (const std::array<double, 4>& o : outside) {
            const double t = i[0] / (i[0] - o[0]);
            include(i[1] + t * (o[1] - i[1]), i[2] + t * (o[2] - i[2]), i[3] + t * (o[3] - i[3]));
        }
    }
    for (int k = 0; k < 3; ++k) {
        bounds[2 * k] = std::max(bounds[2 * k], own[2 * k]);
        bounds[2 * k + 1] = std::min(bounds[2 * k + 1], own[2 * k + 1]);
    }
}

/// Box around the overlap. Its first axis is the normal of the plane that the other body enters
/// least. False if a plane separates the bodies, or the box is empty.
template <class Geometry> bool PairOverlap<Geometry>::find_box(int* separating)
{
    const int first = static_cast<int>(planes[0].size());
    const int all = first + static_cast<int>(planes[1].size());
    const auto entered = [&](int face) {
        const int own = face < first ? 0 : 1, plane = own == 0 ? face : face - first;
        return planes[own][plane].offset - lowest_over(plane, 1 - own);
    };
    std::array<int, 2> best { -1, -1 };
    std::array<double, 2> least { overlap_detail::infinite, overlap_detail::infinite };
    for (int face = 0; face < all; ++face) {
        const int own = face < first ? 0 : 1;
        const double depth = entered(face);
        if (depth < least[own]) {
            least[own] = depth;
            best[own] = own == 0 ? face : face - first;
        }
    }
    const int own = least[0] <= least[1] ? 0 : 1;
    if (best[0] < 0 || best[1] < 0) return false;  // a body without planes or points
    if (separating) *separating = own == 0 ? best[0] : first + best[1];
    if (!(least[own] > 0.0)) return false;
    const Vector normal = planes[own][best[own]].normal;
    const auto [second, third] = Geometry::tangents(normal);
    box.axes = { normal, second, third };
    std::array<double, 6> bounds { -overlap_detail::infinite, overlap_detail::infinite,
        -overlap_detail::infinite, overlap_detail::infinite, -overlap_detail::infinite,
        overlap_detail::infinite };
    extend(0, best[1], bounds);
    extend(1, best[0], bounds);
    box.size = 0.0;
    for (int k = 0; k < 2; ++k)
        for (int i = 0; i < number[k]; ++i)
            box.size =
                std::max({ box.size, std::abs(x[k][i]), std::abs(y[k][i]), std::abs(z[k][i]) });
    box.tie = overlap_detail::round_off * box.size;
    std::array<double, 3> middle {}, half {};
    for (int k = 0; k < 3; ++k) {
        middle[k] = 0.5 * (bounds[2 * k] + bounds[2 * k + 1]);
        half[k] = 0.5 * (bounds[2 * k + 1] - bounds[2 * k]);
        if (half[k] < -10.0 * box.tie) return false;
        half[k] = std::max(half[k], 0.0);
    }
    // Conditions that hold throughout the box are left out. The other conditions then still bound
    // the overlap: it is convex and does not reach the rim of the box. If the overlap is empty they
    // may bound a part outside of the box, which is_in_prism() finds.
    box.slack = 1e-3 * half[0] + 10.0 * box.tie;
    for (double& length : half)
        length += box.slack;
    box.centre = middle[0] * box.axes[0] + middle[1] * box.axes[1] + middle[2] * box.axes[2];
    box.half = { half[0], half[1], half[2] };
    box.reach = norm(box.half);
    return true;
}

/// Smallest and largest normal . x over the prism.
template <class Geometry> std::array<double, 2> PairOverlap<Geometry>::range(Vector normal) const
{
    double least = overlap_detail::infinite, most = -overlap_detail::infinite;
    for (const std::array<double, 2>& at : prism) {
        const double along = normal.y * at[0] + normal.z * at[1];
        least = std::min(least, along);
        most = std::max(most, along);
    }
    const double reach = std::abs(normal.x) * box.half.x;
    return { least - reach, most + reach };
}

/// Prism along the first axis of the box that contains the overlap. Each plane cuts the section of
/// the prism at the outermost position that the plane has between the ends. False if the prism is
/// empty.
template <class Geometry> bool PairOverlap<Geometry>::find_prism()
{
    piece.reserve(static_cast<int>(active.size()));
    piece.start(box.half.y, box.half.z);
    sides.clear();
    for (const Active& p : active) {
        const double reach = std::abs(p.normal.x) * box.half.x + box.slack;
        sides.push_back({ p.depth + reach, p.normal.y, p.normal.z });
        if (!piece.cut(p.depth + reach, p.normal.y, p.normal.z)) return false;
    }
    prism.clear();
    for (int i = 0; i < piece.corners(); ++i)
        prism.push_back(piece.corner(i));
    return true;
}

/// True if a point is in the prism, with half of the slack.
template <class Geometry> bool PairOverlap<Geometry>::is_in_prism(Vector at) const
{
    const double rim = 0.5 * box.slack;
    if (std::abs(at.x) > box.half.x - rim || std::abs(at.y) > box.half.y - rim
        || std::abs(at.z) > box.half.z - rim) {
        return false;
    }
    return std::all_of(sides.begin(), sides.end(), [at, rim](const std::array<double, 3>& side) {
        return side[0] - side[1] * at.y - side[2] * at.z >= rim;
    });
}

/// Planes that may bound the overlap or be nearest to a point of it, those that cut most first.
template <class Geometry> bool PairOverlap<Geometry>::find_active()
{
    active.clear();
    box.largest_depth = overlap_detail::infinite;
    int face = 0;
    for (const std::vector<ContactPlane>& of_body : planes) {
        for (const ContactPlane& p : of_body) {
            const Vector n { dot(p.normal, box.axes[0]), dot(p.normal, box.axes[1]),
                dot(p.normal, box.axes[2]) };
            const double depth = p.offset - dot(p.normal, box.centre);
            const double reach = std::abs(n.x) * box.half.x + std::abs(n.y) * box.half.y
                + std::abs(n.z) * box.half.z;
            if (depth + reach < 0.0) return false;
            if (p.counted) box.largest_depth = std::min(box.largest_depth, depth + reach);
            if (p.counted || depth - reach < 0.0)
                active.push_back({ n, depth, depth - reach, depth + reach, face, p.counted });
            ++face;
        }
    }
    // without a counted plane there is no depth
    if (box.largest_depth == overlap_detail::infinite) return false;
    const auto drop_far = [this] {
        const double depth = box.largest_depth;
        active.erase(std::remove_if(active.begin(), active.end(),
                         [depth](const Active& p) { return p.lowest > (p.counted ? depth : 0.0); }),
            active.end());
    };
    drop_far();
    if (!find_prism()) return false;
    for (Active& p : active) {
        const auto [least, most] = range(p.normal);
        p.lowest = p.depth - most;
        p.highest = p.depth - least;
        if (p.highest < 0.0) return false;
        if (p.counted) box.largest_depth = std::min(box.largest_depth, p.highest);
    }
    drop_far();
    // the smaller one of two depths is at most half of their sum
    for (std::size_t i = 0; i < active.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            const Active &one = active[i], &two = active[k];
            const double twice = one.depth + two.depth;
            if (!one.counted || !two.counted || twice >= 2.0 * box.largest_depth) continue;
            const double both = twice - range(one.normal + two.normal)[0];
            if (both < 0.0) return false;
            box.largest_depth = std::min(box.largest_depth, 0.5 * both);
        }
    }
    drop_far();
    drop_hidden();
    // by insertion: the planes are few
    for (std::size_t i = 1; i < active.size(); ++i) {
        const Active one = active[i];
        std::size_t k = i;
        for (; k > 0 && active[k - 1].highest > one.highest; --k)
            active[k] = active[k - 1];
        active[k] = one;
    }
    return true;
}

/// Drop planes that are nowhere nearest in the prism. Of equal planes the first counts.
template <class Geometry> void PairOverlap<Geometry>::drop_hidden()
{
    is_hidden.assign(active.size(), 0);
    for (std::size_t i = 0; i < active.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            const Active &one = active[i], &two = active[k];
            if (one.counted != two.counted) continue;
            const Vector apart = one.normal - two.normal;
            const double farther = one.depth - two.depth;
            if (dot(apart, apart) <= overlap_detail::round_off * overlap_detail::round_off
                && std::abs(farther) <= box.tie) {
                is_hidden[i] = 1;
                continue;
            }
            const auto [least, most] = range(apart);
            if (farther >= most)
                is_hidden[i] = 1;
            else if (farther <= least)
                is_hidden[k] = 1;
        }
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < active.size(); ++i)
        if (!is_hidden[i]) active[kept++] = active[i];
    active.resize(kept);
}

/// Add the cone from the plane of i over the present piece, which lies in a plane q or in the ridge
/// between i and q.
/// @param factor  of the depth of the apex below q: the height of the cone
template <class Geometry>
void PairOverlap<Geometry>::add_cone(
    std::size_t i, const Active& q, double factor, Vector centre, BodyOverlap& sum)
{
    constexpr double share = Geometry::dimension / (Geometry::dimension + 1.0);
    const Active& p = active[i];
    if (!has_reference) {
        // cones from afar would lose digits of a small overlap
        reference = centre;
        has_reference = true;
        is_astray = !is_in_prism(centre);
    }
    const Vector apex = reference + (p.depth - dot(p.normal, reference)) * p.normal;
    const double height = factor * (q.depth - dot(q.normal, apex));
    const double volume = piece.size() * height / Geometry::dimension;
    const Vector middle = (1.0 - share) * (apex - reference) + share * (centre - reference);
    sums[i].volume += volume;
    sums[i].moment = sums[i].moment + volume * middle;
    sum.energy += 2.0 * volume * share * (p.depth - dot(p.normal, centre));
}

/// Add the ridge on which two counted planes are equally near, to both.
template <class Geometry>
void PairOverlap<Geometry>::add_ridge(std::size_t i, std::size_t j, BodyOverlap& sum)
{
    const Active &p = active[i], &q = active[j];
    const Vector apart = p.normal - q.normal, both = p.normal + q.normal;
    const double difference = p.depth - q.depth, twice = p.depth + q.depth;
    const std::array<double, 2> at = range(apart);
    if (difference < at[0] || difference > at[1]) return;
    const std::array<double, 2> sums_at = range(both);
    if (twice < sums_at[0] || twice - sums_at[1] > 2.0 * box.largest_depth) return;
    const double length = norm(apart);
    if (length <= overlap_detail::round_off) return;
    const Vector normal = (1.0 / length) * apart;
    const auto [first, second] = Geometry::tangents(normal);
    const Vector origin = (difference / length) * normal;
    const double a = p.depth - dot(p.normal, origin);
    const double b = dot(p.normal, first), c = dot(p.normal, second);
    piece.start(box.reach, box.reach);
    if (!piece.cut(a, b, c)) return;
    for (std::size_t k = 0; k < active.size(); ++k) {
        if (k == i || k == j) continue;
        const Active& other = active[k];
        const double one = other.depth - dot(other.normal, origin);
        const double two = dot(other.normal, first), three = dot(other.normal, second);
        if (other.counted) {
            if (!piece.cut(one - a, two - b, three - c)) return;
        } else {
            // a wall that lies in the ridge replaces it
            const bool tied = std::abs(one) <= box.tie && std::abs(two) <= overlap_detail::round_off
                && std::abs(three) <= overlap_detail::round_off;
            if (tied || !piece.cut(one, two, three)) return;
        }
    }
    sum.depth = std::max(sum.depth, piece.largest(a, b, c));
    const std::array<double, 2> middle = piece.centre();
    const Vector centre = origin + middle[0] * first + middle[1] * second;
    add_cone(i, q, 1.0 / length, centre, sum);
    add_cone(j, p, 1.0 / length, centre, sum);
    sums[i].area += 0.5 * length * piece.size();
    sums[j].area += 0.5 * length * piece.size();
}

/// Add the part of a wall to which counted plane i is nearest, to the wall and to the plane.
template <class Geometry>
void PairOverlap<Geometry>::add_wall(std::size_t w, std::size_t i, BodyOverlap& sum)
{
    const Active &wall = active[w], &p = active[i];
    const auto [first, second] = Geometry::tangents(wall.normal);
    const Vector origin = wall.depth * wall.normal;
    const double a = p.depth - dot(p.normal, origin);
    const double b = dot(p.normal, first), c = dot(p.normal, second);
    // A condition that is 0 on the whole wall is decided as if the wall lay a trifle further inwards.
    const auto keeps = [&](double one, double two, double three, double inwards) {
        if (std::abs(one) <= box.tie && std::abs(two) <= overlap_detail::round_off
            && std::abs(three) <= overlap_detail::round_off) {
            return inwards > 0.0;
        }
        return piece.cut(one, two, three);
    };
    piece.start(box.reach, box.reach);
    if (!keeps(a, b, c, dot(p.normal, wall.normal))) return;
    for (std::size_t k = 0; k < active.size(); ++k) {
        if (k == i || k == w) continue;
        const Active& other = active[k];
        const double one = other.depth - dot(other.normal, origin);
        const double two = dot(other.normal, first), three = dot(other.normal, second);
        if (other.counted) {
            const double inwards = dot(other.normal - p.normal, wall.normal);
            if (!keeps(one - a, two - b, three - c, inwards)) return;
        } else if (!keeps(one, two, three, dot(other.normal, wall.normal))) {
            return;
        }
    }
    sum.depth = std::max(sum.depth, piece.largest(a, b, c));
    const std::array<double, 2> at = piece.centre();
    const std::array<double, 3> m = piece.moments();
    const Vector centre = origin + at[0] * first + at[1] * second;
    add_cone(i, wall, 1.0, centre, sum);
    sums[i].area -= dot(p.normal, wall.normal) * piece.size();
    const double pressed = piece.size() * (a - b * at[0] - c * at[1]);
    sums[w].volume += pressed;
    sums[w].moment = sums[w].moment + pressed * (centre - reference) - (b * m[0] + c * m[1]) * first
        - (b * m[1] + c * m[2]) * second;
}

/// Forces on faces, and the pressed area.
template <class Geometry>
void PairOverlap<Geometry>::finish(const ContactBody& a, const ContactBody& b, BodyOverlap& sum)
{
    std::array<double, 2> area {};
    for (std::size_t i = 0; i < active.size(); ++i) {
        if (sums[i].volume == 0.0) continue;
        const int face = active[i].face, own = face < a.faces ? 0 : 1;
        const ContactPlane& p = own == 0 ? a.planes[face] : b.planes[face - a.faces];
        if (p.counted) area[own] += sums[i].area;
        Vector at = reference + (1.0 / sums[i].volume) * sums[i].moment;
        at = at + (active[i].depth - dot(active[i].normal, at)) * active[i].normal;
        const Vector point =
            box.centre - shift[own] + at.x * box.axes[0] + at.y * box.axes[1] + at.z * box.axes[2];
        on_faces.push_back({ face, (-2.0 * sums[i].volume) * p.normal, point });
    }
    sum.area = std::min(area[0], area[1]);
    std::sort(on_faces.begin(), on_faces.end(),
        [](const FaceForce& one, const FaceForce& two) { return one.face < two.face; });
}

template <class Geometry>
BodyOverlap PairOverlap<Geometry>::measure(
    const ContactBody& a, const ContactBody& b, double clearance, int* separating)
{
    BodyOverlap sum;
    on_faces.clear();
    if (separating && is_separating(a, b, clearance, *separating)) return sum;
    const Vector half = 0.5 * (b.centre - a.centre);
    load(a, -half, clearance, 0);
    load(b, half, clearance, 1);
    if (!find_box(separating) || !find_active()) return sum;
    sums.assign(active.size(), Sums {});
    has_reference = is_astray = false;
    piece.reserve(static_cast<int>(active.size()));
    for (std::size_t i = 0; i < active.size(); ++i) {
        for (std::size_t k = 0; k < active.size(); ++k) {
            if (!active[k].counted) continue;
            if (!active[i].counted)
                add_wall(i, k, sum);
            else if (i < k)
                add_ridge(i, k, sum);
            // the planes that were kept have a common part, but all planes together have none
            if (is_astray) return {};
        }
    }
    finish(a, b, sum);
    return sum;
}

template <class Geometry>
double PairOverlap<Geometry>::birth_clearance(const ContactBody& a, const ContactBody& b)
{
    double clearance = 0.0, margin = overlap_detail::birth_margin;
    // a sharp body may keep more than the margin for round-off
    for (BodyOverlap found = measure(a, b, 0.0); found.energy != 0.0 || !on_faces.empty();
         found = measure(a, b, clearance)) {
        clearance += found.depth + margin * box.size;
        margin *= 4.0;
    }
    return clearance;
}

template <class Geometry>
double PairOverlap<Geometry>::clearance_for(
    const ContactBody& a, const ContactBody& b, double energy)
{
    check_not_negative("clearance_for: energy of a pair over K_n", energy, "m^4");
    if (energy == 0.0) return birth_clearance(a, b);
    BodyOverlap found = measure(a, b, 0.0);
    const double size = norm(b.centre - a.centre);
    double low = 0.0, high = found.depth;
    double step = std::max(found.depth, overlap_detail::round_off * size);
    for (int tries = 0; found.energy < energy; ++tries) {
        if (tries == 60) {
            refuse("clearance_for: energy of a pair over K_n", energy, "m^4",
                "must be one that the bodies can have; check that they have counted faces");
        }
        high = low;
        low -= step;
        step *= 2.0;
        found = measure(a, b, low);
    }
    // Newton's rule for the root of the energy, which is nearly linear, within the bounds
    double at = low;
    const double root = std::sqrt(energy);
    for (int tries = 0; tries < 200 && found.energy != energy; ++tries) {
        if (found.energy > energy)
            low = at;
        else
            high = at;
        double volume = 0.0;
        for (const FaceForce& on : on_faces) {
            const bool of_a = on.face < a.faces;
            const ContactPlane& p = of_a ? a.planes[on.face] : b.planes[on.face - a.faces];
            if (p.counted) volume += 0.5 * norm(on.force);
        }
        const double fine = std::sqrt(found.energy);
        double next = at + (fine - root) * fine / volume;
        if (!(next > low && next < high)) next = 0.5 * (low + high);
        if (std::abs(next - at) <= 1e-16 * size || next == low || next == high) break;
        at = next;
        found = measure(a, b, at);
    }
    return at;
}

}  // namespace flexpm
