// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Convex bodies with nodes and faces for tests of their overlap, in both dimensions.
#pragma once

#include <flexpm/kernel/core/quaternion.hpp>
#include <flexpm/kernel/core/random.hpp>
#include <flexpm/kernel/space/overlap.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace convex_bodies {

using namespace flexpm;

inline double between(Random& random, double low, double high)
{
    return low + (high - low) * random.next();
}

/// Vector of a direction that is uniform on the sphere or the circle.
template <class Geometry> Vector direction(Random& random)
{
    for (;;) {
        const Vector v { between(random, -1.0, 1.0), between(random, -1.0, 1.0),
            Geometry::dimension == 3 ? between(random, -1.0, 1.0) : 0.0 };
        if (norm(v) > 0.1 && norm(v) <= 1.0) return (1.0 / norm(v)) * v;
    }
}

template <class Geometry> Quaternion rotation(Random& random)
{
    const Vector axis = Geometry::dimension == 3 ? direction<InSpace>(random) : Vector { 0, 0, 1 };
    return rotation_by(between(random, 0.0, 2.0 * pi) * axis);
}

/// Body whose faces have nodes in common.
template <class Geometry> struct Body {
    Vector centre;
    std::vector<Vector> nodes;            ///< relative to the centre [m]
    std::vector<std::vector<int>> faces;  ///< counter-clockwise as seen from outside
    std::vector<bool> counted;            ///< by face

    std::vector<Vector> corners(int face) const
    {
        std::vector<Vector> of_face;
        for (const int node : faces[face])
            of_face.push_back(nodes[node]);
        return of_face;
    }
};

/// Planes of a body as it is now. The body must outlive its view.
template <class Geometry> struct Planes {
    std::vector<ContactPlane> planes;
    ContactBody view;

    /// @param flat  each face lies in its plane, so that nodes are corners of the planes' body
    explicit Planes(const Body<Geometry>& body, bool flat = true)
    {
        for (std::size_t f = 0; f < body.faces.size(); ++f) {
            const std::vector<Vector> corners = body.corners(static_cast<int>(f));
            planes.push_back(Geometry::plane_of(corners.data(), static_cast<int>(corners.size())));
            planes.back().counted = body.counted[f];
        }
        view = { body.centre, planes.data(), static_cast<int>(planes.size()), body.nodes.data(),
            flat ? static_cast<int>(body.nodes.size()) : 0 };
    }
    Planes(const Planes&) = delete;
};

template <class Geometry>
BodyOverlap overlap_of(PairOverlap<Geometry>& pair, const Body<Geometry>& a,
    const Body<Geometry>& b, double clearance = 0.0, bool flat = true)
{
    const Planes<Geometry> of_a(a, flat), of_b(b, flat);
    return pair.measure(of_a.view, of_b.view, clearance);
}

/// Body behind planes normal . x <= offset, all of which have a face.
template <class Geometry>
Body<Geometry> body_of(const std::vector<Vector>& normals, const std::vector<double>& offsets)
{
    Body<Geometry> body;
    const int n = static_cast<int>(normals.size());
    body.faces.resize(n);
    const auto add = [&](std::vector<int> at, Vector corner) {
        for (int k = 0; k < n; ++k) {
            if (std::find(at.begin(), at.end(), k) == at.end()
                && dot(normals[k], corner) > offsets[k] + 1e-12)
                return;
        }
        for (std::size_t i = 0; i < body.nodes.size(); ++i) {
            // a corner of more faces than needed is found several times
            if (norm(body.nodes[i] - corner) > 1e-10) continue;
            for (const int k : at) {
                std::vector<int>& face = body.faces[k];
                if (std::find(face.begin(), face.end(), i) == face.end())
                    face.push_back(static_cast<int>(i));
            }
            return;
        }
        for (const int k : at)
            body.faces[k].push_back(static_cast<int>(body.nodes.size()));
        body.nodes.push_back(corner);
    };
    const Vector up { 0.0, 0.0, 1.0 };
    for (int i = 0; i < n; ++i) {
        for (int j = i + 1; j < n; ++j) {
            for (int k = Geometry::dimension == 3 ? j + 1 : n; k < n + (Geometry::dimension == 2);
                 ++k) {
                const Vector third = Geometry::dimension == 3 ? normals[k] : up;
                const double volume = triple(normals[i], normals[j], third);
                if (std::abs(volume) < 1e-9) continue;
                const double offset = Geometry::dimension == 3 ? offsets[k] : 0.0;
                const Vector corner = (1.0 / volume)
                    * (offsets[i] * cross(normals[j], third) + offsets[j] * cross(third, normals[i])
                        + offset * cross(normals[i], normals[j]));
                add(Geometry::dimension == 3 ? std::vector<int> { i, j, k }
                                             : std::vector<int> { i, j },
                    corner);
            }
        }
    }
    for (int f = n - 1; f >= 0; --f) {
        std::vector<int>& face = body.faces[f];
        if (static_cast<int>(face.size()) < Geometry::dimension) {
            body.faces.erase(body.faces.begin() + f);
            continue;
        }
        const Vector first = Geometry::dimension == 3 ? normals[f] : Vector { 0.0, 0.0, 1.0 };
        if (Geometry::dimension == 2) {
            if (cross(normals[f], body.nodes[face[1]] - body.nodes[face[0]]).z < 0.0)
                std::swap(face[0], face[1]);
            continue;
        }
        Vector middle;
        for (const int node : face)
            middle = middle + (1.0 / static_cast<double>(face.size())) * body.nodes[node];
        const auto [along, across] = InSpace::tangents(first);
        const auto angle = [&, one = along, two = across](int node) {
            return std::atan2(
                dot(body.nodes[node] - middle, two), dot(body.nodes[node] - middle, one));
        };
        std::sort(face.begin(), face.end(), [&](int i, int j) { return angle(i) < angle(j); });
    }
    body.counted.assign(body.faces.size(), true);
    return body;
}

/// Box about its centre.
template <class Geometry> Body<Geometry> box(Vector half)
{
    std::vector<Vector> normals { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 } };
    std::vector<double> offsets { half.x, half.x, half.y, half.y };
    if (Geometry::dimension == 3) {
        normals.insert(normals.end(), { { 0, 0, 1 }, { 0, 0, -1 } });
        offsets.insert(offsets.end(), { half.z, half.z });
    }
    return body_of<Geometry>(normals, offsets);
}

/// Body with a diameter of about 1 and random faces.
template <class Geometry> Body<Geometry> random_body(Random& random)
{
    // directions that are far from each other, so that most planes have a face
    const int faces = Geometry::dimension == 3 ? 14 : 7;
    std::vector<Vector> normals;
    std::vector<double> offsets;
    const double least = Geometry::dimension == 3 ? 0.65 : 0.5;
    // the box keeps it bounded
    for (int k = 0; k < 2 * Geometry::dimension; ++k) {
        const double sign = k % 2 == 0 ? 1.0 : -1.0;
        normals.push_back(
            { k / 2 == 0 ? sign : 0.0, k / 2 == 1 ? sign : 0.0, k / 2 == 2 ? sign : 0.0 });
    }
    for (int tries = 0; tries < 400 && static_cast<int>(normals.size()) < faces; ++tries) {
        const Vector n = direction<Geometry>(random);
        const auto is_near = [&](Vector other) { return norm(other - n) < least; };
        if (std::none_of(normals.begin(), normals.end(), is_near)) normals.push_back(n);
    }
    const Quaternion turn = rotation<Geometry>(random);
    for (Vector& n : normals) {
        const Vector tilted = n + 0.2 * direction<Geometry>(random);
        n = turned(turn, (1.0 / norm(tilted)) * tilted);
        offsets.push_back(between(random, 0.42, 0.5));
    }
    return body_of<Geometry>(normals, offsets);
}

/// Move the second body along the line of centres until the overlap has a depth [m].
template <class Geometry>
void set_depth(
    PairOverlap<Geometry>& pair, const Body<Geometry>& a, Body<Geometry>& b, double depth)
{
    const Vector apart = b.centre - a.centre, toward = (1.0 / norm(apart)) * apart;
    double low = 0.3, high = 2.0;
    for (int k = 0; k < 12; ++k) {
        const double middle = 0.5 * (low + high);
        b.centre = a.centre + middle * toward;
        (overlap_of(pair, a, b).depth > depth ? low : high) = middle;
    }
    b.centre = a.centre + low * toward;
}

/// Two random bodies that overlap, far from the origin.
template <class Geometry> struct RandomPair {
    Body<Geometry> a, b;

    RandomPair(PairOverlap<Geometry>& pair, Random& random, double depth) :
        a(random_body<Geometry>(random)),
        b(random_body<Geometry>(random))
    {
        a.centre = { 3.0, -2.0, Geometry::dimension == 3 ? 5.0 : 0.0 };
        b.centre = a.centre + direction<Geometry>(random);
        set_depth(pair, a, b, depth);
    }
};

/// Forces of the last pair on the nodes of both bodies, over K_n.
template <class Geometry>
std::array<std::vector<Vector>, 2> nodal_forces(
    const PairOverlap<Geometry>& pair, const Body<Geometry>& a, const Body<Geometry>& b)
{
    std::array<std::vector<Vector>, 2> forces { std::vector<Vector>(a.nodes.size()),
        std::vector<Vector>(b.nodes.size()) };
    const int first = static_cast<int>(a.faces.size());
    for (const FaceForce& on : pair.forces()) {
        const int own = on.face < first ? 0 : 1;
        const Body<Geometry>& body = own == 0 ? a : b;
        const int face = own == 0 ? on.face : on.face - first;
        const std::vector<Vector> corners = body.corners(face);
        std::vector<Vector> shares(corners.size());
        Geometry::spread(corners.data(), static_cast<int>(corners.size()), on, shares.data());
        for (std::size_t k = 0; k < corners.size(); ++k)
            forces[own][body.faces[face][k]] = forces[own][body.faces[face][k]] + shares[k];
    }
    return forces;
}

/// Sum of the forces of the last pair on one body (0: first, 1: second), over K_n.
template <class Geometry>
Vector force_on(const PairOverlap<Geometry>& pair, const Body<Geometry>& a, int body)
{
    Vector sum;
    for (const FaceForce& on : pair.forces())
        if ((on.face < static_cast<int>(a.faces.size())) == (body == 0)) sum = sum + on.force;
    return sum;
}

}  // namespace convex_bodies
