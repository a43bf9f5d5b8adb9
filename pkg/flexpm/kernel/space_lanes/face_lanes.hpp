// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Frames of a block of faces, displacements of their corners and forces on them, `lanes` at a
/// time. Inlined into the functions that are compiled for each instruction set. Vectors are three
/// rows.
#pragma once

#include <flexpm/kernel/assembly/solid_state.hpp>
#include <flexpm/kernel/core/rows_of_four.hpp>

#include <cmath>
#include <type_traits>

namespace flexpm {

/// Place of a lane, as find_places() writes them.
FLEXPM_INLINE FacePlace load_place(const double* places, int l)
{
    const Vector at = load_vector(places, l);
    return { at.x, { at.y, at.z } };
}

FLEXPM_INLINE FacePointState load_state(const double* rows, int l)
{
    return { rows[FaceRow::max_opening * lanes + l],
        { rows[FaceRow::plastic_x * lanes + l], rows[FaceRow::plastic_y * lanes + l] },
        rows[FaceRow::shear_damage * lanes + l], rows[FaceRow::damage_energy * lanes + l],
        rows[FaceRow::friction_energy * lanes + l] };
}

/// Laws of a block of contacts in rows.
struct FaceLaws {
    alignas(64) double rows[row_count<LawParameters> * lanes];
    bool dilating = false, weakening = false;

    void fill(const FaceContacts& contacts, int block)
    {
        dilating = weakening = false;
        for (int l = 0; l < lanes; ++l) {
            const int contact = contacts.in_slot[block * lanes + l];
            // padded lanes follow the first one
            const LawParameters& law =
                contacts.law_of(contact >= 0 ? contact : contacts.in_slot[block * lanes]);
            store_rows(law, rows, l);
            dilating = dilating || law.dilation_compliance > 0.0;
            weakening = weakening || law::weakens(law);
        }
    }
};

struct FaceMotion;

/// What is read of one block of contacts.
struct FaceLanes {
    using Motion = FaceMotion;

    FaceGroup group;
    const double* displacement;  ///< of nodes
    const int* nodes;
    const int* line;
    const double* places;
    const double* areas;
    const double* shares;
    const double* law;  ///< [row of LawParameters][lane]
    bool dilating;      ///< whether any of these laws dilates
    bool weakening;     ///< whether the friction of any of them falls after a crack
};

inline FaceLanes face_lanes(const SolidState& s, int block, const FaceLaws& laws)
{
    const FaceContacts& c = s.contacts;
    const int nodes = c.block_nodes[block];
    return { c.group_in(block), s.grains.displacement.data(), c.nodes.data() + nodes,
        c.line.data() + block * lanes, c.places.data() + nodes / 2 * 3,
        c.areas.data() + c.block_points[block], c.shares.data() + c.block_shares[block], laws.rows,
        laws.dilating, laws.weakening };
}

/// Where the forces of a block go.
struct FaceForces {
    double* force;    ///< of nodes, or wrenches of rigid grains
    double* parcels;  ///< of the block, where they wait; null: added to `force` at once
};

/// Frames of the middle faces of a block: rows of FaceFrame.
struct FrameRows {
    alignas(64) double normal[vector_rows];
    alignas(64) double first[vector_rows];
    alignas(64) double second[vector_rows];
    alignas(64) double area[lanes];
    alignas(64) double span[lanes];
    alignas(64) double lean[lanes];
};

/// What a block works out on the way.
struct FaceMotion : FrameRows {
    alignas(64) double middle[most_corners * vector_rows];  ///< corners of the middle faces
    alignas(64) double apart[most_corners * vector_rows];   ///< ways from side a to side b
    alignas(64) double on_a[most_corners * vector_rows];    ///< forces of the points on side a
    alignas(64) double couple[vector_rows];                 ///< sum of f x jump over the points
};

/// Ways of one corner on a side.
template <bool Wide>
FLEXPM_INLINE void gather_ways(const FaceLanes& b, const int* nodes, double* to)
{
    to_lanes<Wide>(
        [&](int l, Four& row) FLEXPM_INLINED { row = row_of_four(b.displacement + nodes[l]); }, to);
}

template <bool Wide>
FLEXPM_INLINE void find_motion(const FaceLanes& b, FaceMotion& m, std::bool_constant<Wide>)
{
    alignas(64) double of_a[vector_rows], of_b[vector_rows];
    for (int k = 0; k < b.group.corners; ++k) {
        const int row = k * vector_rows;
        gather_ways<Wide>(b, b.nodes + 2 * k * lanes, of_a);
        gather_ways<Wide>(b, b.nodes + (2 * k + 1) * lanes, of_b);
        for (int i = 0; i < vector_rows; ++i) {
            m.apart[row + i] = of_b[i] - of_a[i];
            m.middle[row + i] = b.places[row + i] + 0.5 * (of_a[i] + of_b[i]);
            m.on_a[row + i] = 0.0;
        }
    }
    for (int i = 0; i < vector_rows; ++i)
        m.couple[i] = 0.0;
}

/// Twice the area vectors of the middle faces.
FLEXPM_INLINE void add_area_vectors(const FaceLanes& b, const FaceMotion& m, double* twice)
{
    for (int i = 0; i < vector_rows; ++i)
        twice[i] = 0.0;
    for (int k = 1; k + 1 < b.group.corners; ++k) {
        const double *here = m.middle + k * vector_rows, *next = here + vector_rows;
        FLEXPM_INDEPENDENT
        for (int l = 0; l < lanes; ++l) {
            const Vector origin = load_vector(m.middle, l);
            store_vector(load_vector(twice, l)
                    + cross(load_vector(here, l) - origin, load_vector(next, l) - origin),
                twice, l);
        }
    }
}

/// Areas and lengths below it count as none: what is divided by them stays finite.
constexpr double no_size = 1e-150;

/// Areas and normals of faces from twice their area vectors: of their frames what intact points need.
FLEXPM_INLINE void find_normals(const double* twice, FrameRows& to)
{
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l) {
        const Vector area = load_vector(twice, l);
        const double size = std::max(0.5 * norm(area), no_size);
        store_vector((0.5 / size) * area, to.normal, l);
        to.area[l] = size;
    }
}

/// Tangents of faces, the first of which follows a line from corner 0.
FLEXPM_INLINE void find_tangents(const double* line, FrameRows& to)
{
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l) {
        const Vector normal = load_vector(to.normal, l), along = load_vector(line, l);
        const double lean = dot(along, normal);
        const Vector flat = along - lean * normal;
        const double span = std::max(norm(flat), no_size);
        const Vector first = (1.0 / span) * flat;
        store_vector(first, to.first, l);
        store_vector(cross(normal, first), to.second, l);
        to.span[l] = span;
        to.lean[l] = lean;
    }
}

/// Areas and normals of the middle faces.
FLEXPM_INLINE void find_normals(const FaceLanes& b, FaceMotion& m)
{
    alignas(64) double twice[vector_rows];
    add_area_vectors(b, m, twice);
    find_normals(twice, m);
}

/// Frames of the middle faces.
FLEXPM_INLINE void find_frames(const FaceLanes& b, FaceMotion& m)
{
    find_normals(b, m);
    alignas(64) double line[vector_rows];
    for (int i = 0; i < vector_rows; ++i)
        line[i] = m.middle[i];
    for (int k = 1; k < b.group.corners; ++k) {
        const double* corner = m.middle + k * vector_rows;
        FLEXPM_INDEPENDENT
        for (int l = 0; l < lanes; ++l)
            store_vector(b.line[l] == k ? load_vector(corner, l) : load_vector(line, l), line, l);
    }
    for (int i = 0; i < vector_rows; ++i)
        line[i] -= m.middle[i];
    find_tangents(line, m);
}

/// Lanes whose face has no area or no longest line, but for those of contacts that have ended.
/// @param areas  of the points
FLEXPM_INLINE int count_turned(const FrameRows& m, const double* areas, int points)
{
    int turned = 0;
    for (int l = 0; l < lanes; ++l) {
        if (m.area[l] > no_size && m.span[l] > no_size) continue;
        bool acts = false;
        for (int p = 0; p < points; ++p)
            acts = acts || areas[p * lanes + l] != 0.0;
        turned += acts;
    }
    return turned;
}

/// Ways from a to b at point `p`.
FLEXPM_INLINE void find_jump(const FaceLanes& b, const FaceMotion& m, int p, double* jump)
{
    if (p < b.group.at_corners) {
        for (int i = 0; i < vector_rows; ++i)
            jump[i] = m.apart[p * vector_rows + i];
        return;
    }
    const double* share = b.shares + (p - b.group.at_corners) * b.group.corners * lanes;
    for (int i = 0; i < vector_rows; ++i)
        jump[i] = 0.0;
    for (int k = 0; k < b.group.corners; ++k) {
        for (int axis = 0; axis < 3; ++axis) {
            FLEXPM_INDEPENDENT
            for (int l = 0; l < lanes; ++l) {
                jump[axis * lanes + l] +=
                    share[k * lanes + l] * m.apart[k * vector_rows + axis * lanes + l];
            }
        }
    }
}

/// Opening and slip of a point, three rows, from its way between the sides.
FLEXPM_INLINE void find_places(const FrameRows& m, const double* jump, double* places)
{
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l) {
        const Vector way = load_vector(jump, l);
        store_vector({ dot(way, load_vector(m.normal, l)), dot(way, load_vector(m.first, l)),
                         dot(way, load_vector(m.second, l)) },
            places, l);
    }
}

/// Forces of a point of each contact, for tractions along normal and tangents.
FLEXPM_INLINE void find_force(
    const FrameRows& m, const double* area, const double* traction, double* force)
{
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l) {
        const Vector t = load_vector(traction, l);
        store_vector(area[l]
                * (t.x * load_vector(m.normal, l) + t.y * load_vector(m.first, l)
                    + t.z * load_vector(m.second, l)),
            force, l);
    }
}

/// What points of intact contacts come to: their forces, and openings and sizes of slip squared.
struct IntactRows {
    alignas(64) double force[vector_rows];
    alignas(64) double opening[lanes];
    alignas(64) double slip_squared[lanes];
};

/// Point `p` of each contact while it is intact. Its tractions need no tangents: they are k_s times
/// its way between the sides, and (k_n - k_s) times the opening along the normal.
template <class Lanes>
FLEXPM_INLINE void find_intact(
    const Lanes& b, const FrameRows& m, int p, const double* jump, IntactRows& to)
{
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l) {
        const auto law = load_rows<LawParameters>(b.law, l);
        const Vector way = load_vector(jump, l), normal = load_vector(m.normal, l);
        const double opening = dot(way, normal);
        const double shear = law.shear_stiffness * b.areas[p * lanes + l];
        const double beyond =
            law.normal_stiffness * b.areas[p * lanes + l] * opening - shear * opening;
        store_vector(beyond * normal + shear * way, to.force, l);
        to.opening[l] = opening;
        to.slip_squared[l] = dot(way, way) - opening * opening;
    }
}

/// Add the forces of point `p`, whose places on both sides are `jump` apart, to those on the corners
/// of side a, and their couples.
FLEXPM_INLINE void add_force(
    const FaceLanes& b, int p, const double* force, const double* jump, FaceMotion& m)
{
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l) {
        store_vector(load_vector(m.couple, l) + cross(load_vector(force, l), load_vector(jump, l)),
            m.couple, l);
    }
    if (p < b.group.at_corners) {
        for (int i = 0; i < vector_rows; ++i)
            m.on_a[p * vector_rows + i] += force[i];
        return;
    }
    const double* share = b.shares + (p - b.group.at_corners) * b.group.corners * lanes;
    for (int k = 0; k < b.group.corners; ++k) {
        for (int axis = 0; axis < 3; ++axis) {
            FLEXPM_INDEPENDENT
            for (int l = 0; l < lanes; ++l) {
                m.on_a[k * vector_rows + axis * lanes + l] +=
                    share[k * lanes + l] * force[axis * lanes + l];
            }
        }
    }
}

/// Forces on all corners, with those that take the couples: couple_forces() in lanes, half of them
/// on either side.
///
/// @tparam Intact  true: the couples have no part along the normals
template <bool Intact>
FLEXPM_INLINE void write_forces(
    const FaceLanes& b, const FaceMotion& m, const FaceForces& to, std::bool_constant<Intact>)
{
    alignas(64) double tilting[vector_rows], about[vector_rows], of_a[vector_rows],
        of_b[vector_rows];
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l) {
        const Vector normal = load_vector(m.normal, l);
        Vector tilt = cross(load_vector(m.couple, l), normal);
        if constexpr (!Intact) {
            const Vector second = load_vector(m.second, l);
            const double turn = dot(load_vector(m.couple, l), normal) / m.span[l];
            tilt = tilt - (turn * m.lean[l]) * second;
            store_vector((0.5 * turn) * second, about, l);
        }
        store_vector((-0.25 / m.area[l]) * tilt, tilting, l);
    }
    const int n = b.group.corners;
    for (int k = 0; k < n; ++k) {
        const double* next = m.middle + (k + 1 < n ? k + 1 : 0) * vector_rows;
        const double* last = m.middle + (k > 0 ? k - 1 : n - 1) * vector_rows;
        FLEXPM_INDEPENDENT
        for (int l = 0; l < lanes; ++l) {
            Vector turning =
                cross(load_vector(next, l) - load_vector(last, l), load_vector(tilting, l));
            if constexpr (!Intact) {
                const double ends = (k == 0 ? 1.0 : 0.0) - (k == b.line[l] ? 1.0 : 0.0);
                turning = turning + ends * load_vector(about, l);
            }
            const Vector force = load_vector(m.on_a + k * vector_rows, l);
            store_vector(turning + force, of_a, l);
            store_vector(turning - force, of_b, l);
        }
        const double* sides[] = { of_a, of_b };
        for (int side = 0; side < 2; ++side) {
            const int first = (2 * k + side) * lanes;
            if (to.parcels) {
                from_lanes(sides[side], [&](int l, const Four& f) FLEXPM_INLINED {
                    row_of_four(to.parcels + 4 * (first + l)) = f;
                });
            } else {
                from_lanes(sides[side], [&](int l, const Four& f) FLEXPM_INLINED {
                    row_of_four(to.force + b.nodes[first + l]) += f;
                });
            }
        }
    }
}

}  // namespace flexpm
