// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/space_lanes/rigid_faces.hpp>

#include <flexpm/kernel/space_lanes/face_points.hpp>
#include <flexpm/kernel/space_lanes/solid_bodies.hpp>

#include <array>

namespace flexpm {

namespace {

/// Three vectors in lanes: columns of a tensor.
constexpr int tensor_rows = 3 * vector_rows;

/// What a block works out on the way. Places at the reference are from the middle of the face.
struct RigidFaceMotion : FrameRows {
    alignas(64) double arm[2 * vector_rows];  ///< from each centre to the middle on its side
    alignas(64) double jump[vector_rows];     ///< way between the sides at the middle
    alignas(64) double spread[tensor_rows];   ///< what it is more by, for a place
    alignas(64) double mean[tensor_rows];     ///< mean of both turns
    alignas(64) double force[vector_rows];    ///< sum over the points, on side a
    alignas(
        64) double moments[tensor_rows];  ///< sum of forces times places, for each axis of those
};

/// What is read of one block of contacts.
struct RigidFaceLanes {
    using Motion = RigidFaceMotion;

    FaceGroup group;
    const double* motions;  ///< of grains
    const int* grains;
    const double* faces;   ///< RigidFaceRow
    const double* places;  ///< RigidPlaceRow
    const double* areas;
    const double* law;  ///< [row of LawParameters][lane]
    bool dilating;      ///< whether any of these laws dilates
    bool weakening;     ///< whether the friction of any of them falls after a crack

    FLEXPM_INLINE const double* row(int number) const { return faces + number * lanes; }
    FLEXPM_INLINE const double* line() const { return places + RigidPlaceRow::line * lanes; }
    FLEXPM_INLINE const double* point(int p) const
    {
        return places + (RigidPlaceRow::points + 3 * p) * lanes;
    }
};

/// Three columns of a tensor in a lane.
struct Columns {
    Vector x, y, z;
};

FLEXPM_INLINE Columns load_columns(const double* rows, int l)
{
    return { load_vector(rows, l), load_vector(rows + vector_rows, l),
        load_vector(rows + 2 * vector_rows, l) };
}
FLEXPM_INLINE void store_columns(const Columns& c, double* rows, int l)
{
    store_vector(c.x, rows, l);
    store_vector(c.y, rows + vector_rows, l);
    store_vector(c.z, rows + 2 * vector_rows, l);
}

FLEXPM_INLINE Vector times(const Columns& c, Vector v) { return v.x * c.x + v.y * c.y + v.z * c.z; }

/// The product of the transpose.
FLEXPM_INLINE Vector times_transposed(const Columns& c, Vector v)
{
    return { dot(c.x, v), dot(c.y, v), dot(c.z, v) };
}

template <bool Wide>
FLEXPM_INLINE void find_motion(
    const RigidFaceLanes& b, RigidFaceMotion& m, std::bool_constant<Wide>)
{
    alignas(64) double way[2][vector_rows], turn[2][tensor_rows];
    for (int side = 0; side < 2; ++side) {
        const int* grains = b.grains + side * lanes;
        const auto read = [&](int row, double* to) FLEXPM_INLINED {
            to_lanes<Wide>(
                [&](int l, Four& values) FLEXPM_INLINED {
                    values = row_of_four(b.motions + grains[l] * RigidMotionRow::count + row);
                },
                to);
        };
        read(RigidMotionRow::way, way[side]);
        read(RigidMotionRow::of_x, turn[side]);
        read(RigidMotionRow::of_y, turn[side] + vector_rows);
        read(RigidMotionRow::of_z, turn[side] + 2 * vector_rows);
    }
    const double *arm_a = b.row(RigidFaceRow::arm_a), *arm_b = b.row(RigidFaceRow::arm_b);
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l) {
        const Columns a = load_columns(turn[0], l), of_b = load_columns(turn[1], l);
        const Vector more_a = times(a, load_vector(arm_a, l)),
                     more_b = times(of_b, load_vector(arm_b, l));
        store_vector(load_vector(arm_a, l) + more_a, m.arm, l);
        store_vector(load_vector(arm_b, l) + more_b, m.arm + vector_rows, l);
        store_vector(
            (load_vector(way[1], l) + more_b) - (load_vector(way[0], l) + more_a), m.jump, l);
        store_columns({ of_b.x - a.x, of_b.y - a.y, of_b.z - a.z }, m.spread, l);
        const Vector x { 1.0, 0.0, 0.0 }, y { 0.0, 1.0, 0.0 }, z { 0.0, 0.0, 1.0 };
        store_columns(
            { x + 0.5 * (a.x + of_b.x), y + 0.5 * (a.y + of_b.y), z + 0.5 * (a.z + of_b.z) },
            m.mean, l);
    }
    for (int i = 0; i < vector_rows; ++i)
        m.force[i] = 0.0;
    for (int i = 0; i < tensor_rows; ++i)
        m.moments[i] = 0.0;
}

/// The mean turn carries a face to the middle one, and its cofactors carry the area.
FLEXPM_INLINE void find_normals(const RigidFaceLanes& b, RigidFaceMotion& m)
{
    alignas(64) double twice[vector_rows];
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l) {
        const Columns mean = load_columns(m.mean, l);
        const Columns cofactors { cross(mean.y, mean.z), cross(mean.z, mean.x),
            cross(mean.x, mean.y) };
        store_vector(times(cofactors, load_vector(b.row(RigidFaceRow::area), l)), twice, l);
    }
    find_normals(twice, m);
}

FLEXPM_INLINE void find_frames(const RigidFaceLanes& b, RigidFaceMotion& m)
{
    find_normals(b, m);
    const double* line = b.line();
    alignas(64) double present[vector_rows];
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l) {
        store_vector(times(load_columns(m.mean, l), load_vector(line, l)), present, l);
        // all that looks at the corners has lost a face so far away by rounding
        constexpr double farthest = 1e14;
        const Vector way = load_vector(m.jump, l);
        const bool near = dot(way, way) <= farthest * farthest * m.area[l];
        m.area[l] = near ? m.area[l] : no_size;
    }
    find_tangents(present, m);
}

FLEXPM_INLINE void find_jump(const RigidFaceLanes& b, const RigidFaceMotion& m, int p, double* jump)
{
    const double* place = b.point(p);
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l) {
        store_vector(
            load_vector(m.jump, l) + times(load_columns(m.spread, l), load_vector(place, l)), jump,
            l);
    }
}

FLEXPM_INLINE void add_force(
    const RigidFaceLanes& b, int p, const double* force, const double*, RigidFaceMotion& m)
{
    const double* place = b.point(p);
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l) {
        const Vector f = load_vector(force, l), at = load_vector(place, l);
        store_vector(load_vector(m.force, l) + f, m.force, l);
        const Columns sum = load_columns(m.moments, l);
        store_columns({ sum.x + at.x * f, sum.y + at.y * f, sum.z + at.z * f }, m.moments, l);
    }
}

/// Tractions of an intact point are linear in its way between the sides, and that is linear in its
/// place: the forces follow from the moments of the areas. The way anywhere on a face differs from
/// that in the middle by at most the norm of `spread` times the radius; where this does not do, the
/// points are looked at one by one.
FLEXPM_INLINE bool hold_points(const RigidFaceLanes& b, RigidFaceMotion& m)
{
    alignas(64) std::int64_t leaves[lanes];
    const double *areas = b.row(RigidFaceRow::sum), *second = b.row(RigidFaceRow::second),
                 *radius = b.row(RigidFaceRow::radius);
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l) {
        const auto law = load_rows<LawParameters>(b.law, l);
        const Vector way = load_vector(m.jump, l), normal = load_vector(m.normal, l);
        const Columns spread = load_columns(m.spread, l);
        const double beyond = law.normal_stiffness - law.shear_stiffness;
        const auto force_of = [&](Vector v) FLEXPM_INLINED {
            return law.shear_stiffness * v + (beyond * dot(v, normal)) * normal;
        };
        store_vector(areas[l] * force_of(way), m.force, l);
        const Vector own = load_vector(second, l), mixed = load_vector(second + vector_rows, l);
        store_columns({ force_of(times(spread, { own.x, mixed.z, mixed.y })),
                          force_of(times(spread, { mixed.z, own.y, mixed.x })),
                          force_of(times(spread, { mixed.y, mixed.x, own.z })) },
            m.moments, l);
        const double more = radius[l]
            * std::sqrt(
                dot(spread.x, spread.x) + dot(spread.y, spread.y) + dot(spread.z, spread.z));
        const double opening = dot(way, normal);
        const double slip = std::sqrt(std::fabs(dot(way, way) - opening * opening)) + more;
        const bool holds = (m.area[l] > no_size) & holds_intact(law, opening + more, slip * slip);
        leaves[l] = holds ? 0 : 1;
    }
    if (!any_of(leaves)) return true;
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l)
        leaves[l] = m.area[l] > no_size ? 0 : 1;
    alignas(64) double jump[vector_rows];
    for (int p = 0; p < b.group.points; ++p) {
        find_jump(b, m, p, jump);
        FLEXPM_INDEPENDENT
        for (int l = 0; l < lanes; ++l) {
            const Vector way = load_vector(jump, l);
            const double opening = dot(way, load_vector(m.normal, l));
            const bool holds = holds_intact(
                load_rows<LawParameters>(b.law, l), opening, dot(way, way) - opening * opening);
            leaves[l] |= holds ? 0 : 1;
        }
    }
    return !any_of(leaves);
}

/// Twice the vector of the skew part of a^T b.
FLEXPM_INLINE Vector skew_of(const Columns& a, const Columns& b)
{
    return { dot(a.y, b.z) - dot(a.z, b.y), dot(a.z, b.x) - dot(a.x, b.z),
        dot(a.x, b.y) - dot(a.y, b.x) };
}

/// Moments on both sides about their centres. Forces act in the places on either side. Frames turn
/// with both sides, so that the forces that take the couples, see write_forces() of nodes, act
/// there, too: half of the couples on either side, but for what the turns differ by.
///
/// @tparam Intact  true: the couples have no part along the normals
template <bool Intact>
FLEXPM_INLINE void find_moments(
    const RigidFaceLanes& b, const RigidFaceMotion& m, double* on_a, double* on_b)
{
    const double* line = b.line();
    FLEXPM_INDEPENDENT
    for (int l = 0; l < lanes; ++l) {
        const Vector force = load_vector(m.force, l), jump = load_vector(m.jump, l),
                     normal = load_vector(m.normal, l);
        const Columns spread = load_columns(m.spread, l), mean = load_columns(m.mean, l),
                      moments = load_columns(m.moments, l);
        const auto about_middle = [&](const Columns& turn) FLEXPM_INLINED {
            return cross(turn.x, moments.x) + cross(turn.y, moments.y) + cross(turn.z, moments.z);
        };
        const Vector at_middle = cross(force, jump), couple = at_middle - about_middle(spread);
        Vector tilt = cross(couple, normal), uneven;
        if constexpr (!Intact) {
            const Vector second = load_vector(m.second, l);
            const double turn = dot(couple, normal) / m.span[l];
            tilt = tilt - (turn * m.lean[l]) * second;
            uneven = 0.25 * turn * cross(second, times(spread, load_vector(line, l)));
        }
        const Vector tilting = (-0.25 / m.area[l]) * tilt;
        // 0.5 of twice the area vector, and 0.5 of it on either side
        const Vector area = 0.5 * load_vector(b.row(RigidFaceRow::area), l);
        uneven = uneven + times(mean, cross(area, times_transposed(spread, tilting)))
            + dot(area, skew_of(mean, spread)) * tilting;
        const Vector even = about_middle(mean);
        const Vector half = 0.5 * at_middle;
        store_vector(cross(load_vector(m.arm, l), force) + even - half - uneven, on_a, l);
        store_vector(
            uneven - half - even - cross(load_vector(m.arm + vector_rows, l), force), on_b, l);
    }
}

template <bool Intact>
FLEXPM_INLINE void write_forces(const RigidFaceLanes& b, const RigidFaceMotion& m,
    const FaceForces& to, std::bool_constant<Intact>)
{
    alignas(64) double moment[2][vector_rows];
    find_moments<Intact>(b, m, moment[0], moment[1]);
    const auto add = [&](int side, int row, const double* values, double sign) FLEXPM_INLINED {
        from_lanes(values, [&](int l, const Four& v) FLEXPM_INLINED {
            const int in = side * lanes + l;
            if (to.parcels) {
                row_of_four(to.parcels + in * WrenchRow::count + row) = sign * v;
            } else {
                row_of_four(to.force + b.grains[in] * WrenchRow::count + row) += sign * v;
            }
        });
    };
    for (int side = 0; side < 2; ++side) {
        add(side, WrenchRow::force, m.force, side == 0 ? 1.0 : -1.0);
        add(side, WrenchRow::moment, moment[side], 1.0);
    }
}

/// Blocks whose faces move with rigid grains.
struct RigidFaces {
    using Lanes = RigidFaceLanes;

    static void prefetch(const SolidState& s, int block)
    {
        prefetch_rows(s.plan.face_grains.data() + 2 * block * lanes, 2);
        prefetch_rows(s.plan.faces.data() + SolidPlan::first_face(block), RigidFaceRow::count);
        if (s.contacts.states[block].empty()) return;
        prefetch_rows(s.plan.face_places.data() + SolidPlan::first_place(s.contacts, block),
            RigidPlaceRow::count(s.contacts.group_in(block).points));
        prefetch_states(s.contacts, block);
    }

    static RigidFaceLanes lanes_of(const SolidState& s, int block, const FaceLaws& laws)
    {
        const FaceContacts& c = s.contacts;
        return { c.group_in(block), s.plan.motions.data(),
            s.plan.face_grains.data() + 2 * block * lanes,
            s.plan.faces.data() + SolidPlan::first_face(block),
            s.plan.face_places.data() + SolidPlan::first_place(c, block),
            c.areas.data() + c.block_points[block], laws.rows, laws.dilating, laws.weakening };
    }

    static FaceForces forces_of(SolidState& s, int block)
    {
        const int parcels = s.plan.first_parcel[block];
        return { s.plan.wrenches.data(), parcels < 0 ? nullptr : s.plan.parcels.data() + parcels };
    }

    /// States of a block whose points have been elastic until the step: intact, with the slips
    /// before it, which follow from where the grains were.
    static Array<double> first_states(
        const SolidState& s, int block, const FaceLaws& laws, double dt)
    {
        constexpr int sides = 2 * lanes;
        alignas(64) double before[sides * RigidMotionRow::count];
        std::array<int, sides> own {};
        RigidFaceLanes b = lanes_of(s, block, laws);
        for (int i = 0; i < sides; ++i) {
            const int grain = s.plan.body_places[b.grains[i]].grain;
            write_motion(motion_before(s, grain, dt), before + i * RigidMotionRow::count);
            own[i] = i;
        }
        b.motions = before;
        b.grains = own.data();
        Array<double> states(s.contacts.state_count(block), 0.0);
        variant_of<find_slips<RigidFaceLanes, false>, find_slips<RigidFaceLanes, true>>()(
            b, states.data());
        return states;
    }
};

}  // namespace

int update_rigid_blocks(SolidState& s, int first, int end, double dt)
{
    return update_blocks<RigidFaces>(s, first, end, dt);
}

}  // namespace flexpm
