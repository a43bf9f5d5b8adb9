// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  A step of one local contact point by the bilinear law of bilinear.hpp. The law itself
/// (namespace law) knows sizes along the direction of shear and no tangent. The functions below it
/// put the point's tangent to it: one in the plane; a point with two takes the norm where one takes
/// the absolute value.
#pragma once

#include <flexpm/kernel/law/bilinear.hpp>

#include <algorithm>
#include <cmath>

namespace flexpm {

namespace law {

/// A step that is tried: where the point goes, and its shear traction if nothing limited it.
struct Trial {
    double opening;  ///< at the end of the step [m]
    double gap;      ///< the same less the dilation until the step [m]
    double shear;    ///< size of the shear traction without a limit [Pa], >= 0
    double along;    ///< shear traction before the step along that direction [Pa]
};

/// What the law makes of it.
struct Response {
    double normal;         ///< traction [Pa], tension positive
    double shear;          ///< size of the traction along that of the trial [Pa], >= 0
    double damage_before;  ///< D [-]
    double damage;
    double max_opening;      ///< [m]
    double shear_damage;     ///< D_s [-]
    double damage_energy;    ///< dissipated by damage in the step [J/m^2]
    double friction_energy;  ///< the same by friction
};

/// Energy [J/m^2] that goes from friction into the gap when dilation changes it at one damage.
inline double lifting_work(double gap_before, double normal_before, double gap, double normal)
{
    return 0.5 * (gap * normal - gap_before * normal_before);
}

/// Step of a point: tensile damage, normal traction, shear return with its damage in closed form,
/// and the normal traction once more with the new damage and dilation. It has no branches, so that
/// eight points advance at once.
///
/// @tparam Dilating  false: the law does not dilate
/// @param shear_damage  before the step, as `max_opening`
/// @param plastic  plastic(size): eta K_n |s_p| at the end of the step if the shear traction has
///         that size [Pa]
template <bool Dilating, class Plastic>
FLEXPM_INLINE Response respond(const LawParameters& p, const Trial& trial, double max_opening,
    double shear_damage, Plastic plastic)
{
    const double before = damage(p, max_opening, shear_damage);
    const double opening = trial.gap, size = trial.shear;
    const double largest = std::max(max_opening, opening);
    const double normal_part = normal_damage(p, largest);
    const double opened = std::min(normal_part + shear_damage, 1.0);
    const double first_normal = normal_traction(p, opening, largest, opened);

    const double limit = (1.0 - opened) * p.cohesion - p.friction * first_normal;
    const double excess = std::max(size - std::max(limit, 0.0), 0.0);
    const double slip_left = (1.0 - opened) * p.critical_slip;
    const double softening = p.cohesion / p.critical_slip;
    const double damaging = std::min(excess * p.slip_compliance, slip_left);
    const double new_limit = std::max(limit - softening * damaging, 0.0);
    const double shear = excess > 0.0 ? std::min(size, new_limit) : size;
    const double slip = (size - shear) / p.shear_stiffness;
    // both tests: round-off in `slip`, and brittle shear under tension, which slips less than
    // slip_left
    const bool used_up = (damaging >= slip_left) | (slip >= slip_left);
    const double sheared =
        excess > 0.0 ? (used_up ? 1.0 : shear_damage + slip / p.critical_slip) : shear_damage;
    const double after = std::min(normal_part + sheared, 1.0);
    const double normal = normal_traction(p, opening, largest, after);
    const double lifted =
        Dilating && excess > 0.0 ? trial.opening - dilated(p, plastic(shear)) : opening;
    const double lifted_normal = Dilating ? normal_traction(p, lifted, largest, after) : normal;

    // normal: growth of the largest opening at the old shear damage, then the loss of secant slope
    const double opening_loss = opening_dissipation(p, largest, shear_damage)
        - opening_dissipation(p, max_opening, shear_damage);
    const double secant_loss = 0.5 * opening * (first_normal - normal);
    // shear: the trapezoidal work of the step less what it stores, never below zero (a reversal in
    // one step); what friction does not take is damage
    const double shear_loss = 0.5 * std::max(trial.along + shear, 0.0) * slip;
    const double resisted = std::max(-p.friction * first_normal, 0.0) * slip;
    const double friction_loss = before >= 1.0 ? shear_loss : std::min(resisted, shear_loss);

    return { lifted_normal, shear, before, after, largest, sheared,
        opening_loss + secant_loss + (shear_loss - friction_loss),
        Dilating ? friction_loss - lifting_work(opening, normal, lifted, lifted_normal)
                 : friction_loss };
}

/// The branch that a point is on, at a gap.
struct Branch {
    double normal;       ///< traction [Pa]
    double limit;        ///< size of the shear traction that it bears without slip [Pa]
    double damage;       ///< D [-]
    double max_opening;  ///< [m]
    bool same_secant;    ///< the opening does not leave it
};

/// @tparam Intact  true: the point has no damage, which need not be worked out
template <bool Intact>
FLEXPM_INLINE Branch branch_at(
    const LawParameters& p, double gap, double max_opening, double shear_damage)
{
    const double d = Intact ? 0.0 : damage(p, max_opening, shear_damage);
    const double largest = std::max(max_opening, gap);
    const double slope = Intact ? p.normal_stiffness : secant(p, max_opening, d);
    const double normal = gap * (gap > 0.0 ? slope : p.normal_stiffness);
    const double limit = std::max((1.0 - d) * p.cohesion - p.friction * normal, 0.0);
    // a new largest opening stays elastic below the strength that is left, hence below u_e
    const bool same_secant =
        (largest == max_opening) | (p.normal_stiffness * largest <= (1.0 - d) * p.tensile_strength);
    return { normal, limit, d, largest, same_secant };
}

/// Tractions that friction leaves [Pa], the shear as a size, and energy [J/m^2] that it takes in a
/// step.
struct Friction {
    double shear;
    double normal;
    double loss;
};

/// Friction of a point that shear has used up (D_s = 1), which carries no tension and cannot be
/// damaged further: respond() in short. `normal` is the traction on its branch.
template <bool Dilating, class Plastic>
FLEXPM_INLINE Friction rub(
    const LawParameters& p, double normal, const Trial& trial, Plastic plastic)
{
    const double limit = std::max(-p.friction * normal, 0.0);
    const double shear = std::min(trial.shear, limit);
    const double slip = (trial.shear - shear) / p.shear_stiffness;
    const double loss = 0.5 * std::max(trial.along + shear, 0.0) * slip;
    if (!Dilating) return { shear, normal, loss };
    const double gap = trial.opening - dilated(p, plastic(shear));
    const double lifted = p.normal_stiffness * std::min(gap, 0.0);
    return { shear, lifted, loss - lifting_work(trial.gap, normal, gap, lifted) };
}

/// dilated() of a point, or 0 where no law at hand dilates.
template <bool Dilating>
FLEXPM_INLINE double dilated_if(const LawParameters& p, double slip, double shear_traction)
{
    return Dilating ? dilated(p, slip, shear_traction) : 0.0;
}

}  // namespace law

/// Normal and shear traction of a point [Pa] and its damage before and after the step.
struct Traction {
    double normal;
    double shear;
    double damage_before;
    double damage;
};

/// Advance a point by an increment of opening and slip [m].
///
/// @tparam Dilating  false: the law does not dilate
template <bool Dilating = true>
FLEXPM_INLINE Traction advance_point(
    const LawParameters& p, double opening_step, double slip_step, PointState& s)
{
    const double apart = s.opening + opening_step, slipped = s.slip + slip_step;
    const double gap = apart - law::dilated_if<Dilating>(p, s.slip, s.shear_traction);
    const double shear = s.shear_traction + p.shear_stiffness * slip_step;
    const law::Trial trial { apart, gap, std::fabs(shear),
        std::copysign(1.0, shear) * s.shear_traction };
    const auto plastic = [&](double size) FLEXPM_INLINED {
        return std::fabs(p.shear_stiffness * slipped - std::copysign(size, shear));
    };
    const law::Response r =
        law::respond<Dilating>(p, trial, s.max_opening, s.shear_damage, plastic);
    s.opening = apart;
    s.max_opening = r.max_opening;
    s.shear_traction = std::copysign(r.shear, shear);
    s.slip = slipped;
    s.shear_damage = r.shear_damage;
    s.damage_energy += r.damage_energy;
    s.friction_energy += r.friction_energy;
    return { r.normal, s.shear_traction, r.damage_before, r.damage };
}

/// Advance a point that stays on its current branch: no new damage, no slip. Returns false, and the
/// point is not where `next` says, if it would not.
///
/// @tparam Intact  true: the point has no damage, which need not be worked out
/// @tparam Dilating  false: the law does not dilate
template <bool Intact = false, bool Dilating = true>
FLEXPM_INLINE bool advance_elastic(const LawParameters& p, double opening_step, double slip_step,
    const PointState& s, PointState& next, Traction& traction)
{
    const double apart = s.opening + opening_step;
    const double gap = apart - law::dilated_if<Dilating>(p, s.slip, s.shear_traction);
    const law::Branch on = law::branch_at<Intact>(p, gap, s.max_opening, s.shear_damage);
    const double shear = s.shear_traction + p.shear_stiffness * slip_step;
    next = s;
    next.opening = apart;
    next.max_opening = on.max_opening;
    next.shear_traction = shear;
    next.slip = s.slip + slip_step;
    traction = { on.normal, shear, on.damage, on.damage };
    return on.same_secant & (std::fabs(shear) <= on.limit);
}

/// Tractions [Pa] that friction leaves and energy [J/m^2] that it takes in a step.
struct Sliding {
    double shear;
    double normal;
    double loss;
};

/// Friction of a point that shear has used up. Together with advance_elastic() this is the whole
/// step of such a point. `tried` is what that has made of `before`, with the tractions that the
/// point would have without friction.
template <bool Dilating = true>
FLEXPM_INLINE Sliding slide_used_up(
    const LawParameters& p, double normal, const PointState& before, const PointState& tried)
{
    const double gap =
        tried.opening - law::dilated_if<Dilating>(p, before.slip, before.shear_traction);
    const law::Trial trial { tried.opening, gap, std::fabs(tried.shear_traction),
        std::copysign(1.0, tried.shear_traction) * before.shear_traction };
    const auto plastic = [&](double size) FLEXPM_INLINED {
        return std::fabs(
            p.shear_stiffness * tried.slip - std::copysign(size, tried.shear_traction));
    };
    const law::Friction held = law::rub<Dilating>(p, normal, trial, plastic);
    return { std::copysign(held.shear, tried.shear_traction), held.normal, held.loss };
}

}  // namespace flexpm
