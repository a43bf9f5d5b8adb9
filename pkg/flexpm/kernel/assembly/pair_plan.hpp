// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  What a step derives from the state for pairs of grains that have no face in common.
#pragma once

#include <flexpm/kernel/geometry/overlap.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace flexpm {

/// Faces of all grains: of contacts and of triangles of the surface, joined where they lie in one
/// plane.
struct BodyFaces {
    std::vector<int> first;           ///< of each grain, and the end
    std::vector<std::uint8_t> outer;  ///< of each face: 1 if a part of it is on the surface
    std::vector<int> first_contact;   ///< of each face, in `contacts`, and the end
    std::vector<int> contacts;        ///< that lie on the face
    std::vector<int> first_corner;    ///< of each face, in `corners`, and the end
    std::vector<int> corners;         ///< nodes, counter-clockwise as seen from outside
};

/// A corner of a body, where three of its planes meet. It exists unless a near plane cuts it off.
struct BodyCorner {
    std::array<int, 3> planes;
    std::vector<int> near;
};

/// A grain as the convex body behind its faces.
struct GrainBody {
    int grain = 0;
    Vector centre;                     ///< where it is now [m]
    std::vector<ContactPlane> planes;  ///< of its faces, from the centre
    std::vector<Vector> corners;       ///< of the body, from the centre [m]
    /// Of a rigid grain the same at the reference; empty of others.
    std::vector<ContactPlane> bonded_planes;
    std::vector<Vector> bonded_corners;
    /// Of a deformable grain, as of the last search for pairs; empty of others.
    std::vector<BodyCorner> corner_planes;

    ContactBody view() const
    {
        return { centre, planes.data(), static_cast<int>(planes.size()), corners.data(),
            static_cast<int>(corners.size()) };
    }
};

/// What a pair does on one of its grains: forces on nodes, and of a rigid grain, which reads these
/// alone, their sum and moment about its centre.
struct PairLoad {
    std::vector<int> nodes;
    std::vector<Vector> forces;  ///< of each of the nodes [N]
    std::vector<int> faces;      ///< that are pressed, as in BodyFaces
    Vector force;                ///< [N]
    Vector moment;               ///< [N m]
};

struct PairWork {
    std::array<int, 2> bodies { 0, 0 };
    int separating = -1;  ///< plane that kept the bodies apart last, see PairOverlap::measure()
    std::array<PairLoad, 2> loads;
};

/// A load of a pair on a grain.
struct PairUse {
    int pair;
    int side;
};

struct PairPlan {
    BodyFaces faces;                ///< empty as long as there are no pairs
    std::vector<GrainBody> bodies;  ///< of grains in pairs
    std::vector<PairWork> pairs;    ///< of each pair
    std::vector<int> first_use;     ///< of each block of grains in `uses`, and the end; empty: none
    std::vector<PairUse> uses;      ///< in the order of pairs

    bool empty() const { return pairs.empty(); }
};

}  // namespace flexpm
