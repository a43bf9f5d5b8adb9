// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  A step of one point of a face in space by the bilinear law: bilinear_step.hpp with two
/// tangents. Opening and slip are those of the present place relative to the bonded state, not
/// increments (deviation D67), so a point has no direction but that of its plastic slip. A `Point`
/// is a vector of the face's two tangents. Opening and tension are positive. SI units.
#pragma once

#include <flexpm/kernel/core/vector.hpp>
#include <flexpm/kernel/law/bilinear_step.hpp>

#include <cmath>

namespace flexpm {

/// State of a point of a face, which is all that it needs to continue. All zero means bonded and
/// never loaded beyond its strength.
struct FacePointState {
    double max_opening = 0.0;      ///< largest opening less dilation so far [m], >= 0
    Point plastic_slip;            ///< along the tangents [m]
    double shear_damage = 0.0;     ///< D_s [-]: plastic slip / s_c, at most 1
    double damage_energy = 0.0;    ///< dissipated by damage [J/m^2]
    double friction_energy = 0.0;  ///< dissipated by friction [J/m^2]
};

/// Tractions of a point of a face [Pa] and its damage before and after the step.
struct FaceTraction {
    double normal;
    Point shear;
    double damage_before;
    double damage;
};

/// Where a point is: opening and slip since it was bonded [m].
struct FacePlace {
    double opening = 0.0;
    Point slip;
};

namespace law {

inline double length(Point p) { return std::sqrt(dot(p, p)); }

/// Opening less what dilation has made of it [m].
inline double gap(const LawParameters& p, double opening, const FacePointState& s)
{
    return opening - dilated(p, p.shear_stiffness * length(s.plastic_slip));
}

/// Energy stored by a point of a face [J/m^2].
inline double elastic_energy(const LawParameters& p, const FacePlace& at, const FacePointState& s)
{
    const double opening = gap(p, at.opening, s);
    const Point slip = at.slip - s.plastic_slip;
    return 0.5 * opening
        * normal_traction(p, opening, s.max_opening, damage(p, s.max_opening, s.shear_damage))
        + 0.5 * p.shear_stiffness * dot(slip, slip);
}

}  // namespace law

/// Tractions of a point by its state.
FLEXPM_INLINE FaceTraction traction_at(
    const LawParameters& p, const FacePlace& at, const FacePointState& s)
{
    const double damage = law::damage(p, s.max_opening, s.shear_damage);
    const double opening = law::gap(p, at.opening, s);
    return { law::normal_traction(p, opening, s.max_opening, damage),
        p.shear_stiffness * (at.slip - s.plastic_slip), damage, damage };
}

/// Advance a point of a face to the place `at`. The shear traction returns along its radius.
///
/// @tparam Dilating  false: the law does not dilate
/// @param slip_before  slip at the end of the step before, for the work of the step
template <bool Dilating = true>
FLEXPM_INLINE FaceTraction advance_face_point(
    const LawParameters& p, const FacePlace& at, Point slip_before, FacePointState& s)
{
    const Point tried = p.shear_stiffness * (at.slip - s.plastic_slip);
    const double size = law::length(tried);
    const Point direction = size > 0.0 ? (1.0 / size) * tried : Point { 1.0, 0.0 };
    const double along = p.shear_stiffness * dot(direction, slip_before - s.plastic_slip);
    const double gap = Dilating ? law::gap(p, at.opening, s) : at.opening;
    const auto plastic = [&](double held) FLEXPM_INLINED {
        return law::length(p.shear_stiffness * at.slip - held * direction);
    };
    const law::Response r = law::respond<Dilating>(
        p, { at.opening, gap, size, along }, s.max_opening, s.shear_damage, plastic);
    // what is left elastic keeps its digits: the plastic slip only changes where a point slides
    if (r.shear < size) s.plastic_slip = at.slip - (r.shear / p.shear_stiffness) * direction;
    s.max_opening = r.max_opening;
    s.shear_damage = r.shear_damage;
    s.damage_energy += r.damage_energy;
    s.friction_energy += r.friction_energy;
    return { r.normal, r.shear * direction, r.damage_before, r.damage };
}

/// Traction at `at` of a point that stays on its current branch: no new damage, no slip. Returns
/// false if it would not. Of the state only the largest opening could change, by what no later step
/// depends on as long as the point is undamaged.
///
/// @tparam Intact  true: the point has no damage, which need not be worked out
/// @tparam Dilating  false: the law does not dilate
template <bool Intact = false, bool Dilating = true>
FLEXPM_INLINE bool hold_face_point(const LawParameters& p, const FacePlace& at,
    const FacePointState& s, double& max_opening, FaceTraction& traction)
{
    const Point tried = p.shear_stiffness * (at.slip - s.plastic_slip);
    const double gap = Dilating ? law::gap(p, at.opening, s) : at.opening;
    const law::Branch on = law::branch_at<Intact>(p, gap, s.max_opening, s.shear_damage);
    max_opening = on.max_opening;
    traction = { on.normal, tried, on.damage, on.damage };
    return on.same_secant & (dot(tried, tried) <= on.limit * on.limit);
}

/// Whether a point that has been elastic so far stays so.
///
/// @param slip_squared  of the slip's size [m^2]
FLEXPM_INLINE bool holds_intact(const LawParameters& p, double opening, double slip_squared)
{
    const law::Branch on = law::branch_at<true>(p, opening, 0.0, 0.0);
    return on.same_secant
        & (p.shear_stiffness * p.shear_stiffness * slip_squared <= on.limit * on.limit);
}

}  // namespace flexpm
