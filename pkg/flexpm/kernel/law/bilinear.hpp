// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Bilinear softening of one local contact point, paper Sec. 2.5-2.6, Eqs. 22-27 and Fig. 3.
/// Opening and tension are positive, slip is counted along the contact's tangent. SI units.
/// Deviation D1: Eqs. 26-27 print D; D = 1 means cracked, so strengths are multiplied by (1 - D).
/// Deviation D2: damage follows the largest opening and the plastic slip so far; no healing.
/// Deviation D3: unloading in tension goes along the secant.
/// Deviation D43: plastic slip opens a joint that dilates, and slip back closes it.
#pragma once

#include <flexpm/kernel/core/compiler.hpp>

#include <algorithm>
#include <cmath>

namespace flexpm {

/// Properties of a contact between two grains as a user gives them.
struct ContactMaterial {
    double normal_stiffness = 0.0;  ///< K_n    [Pa/m], > 0
    double shear_ratio = 0.0;       ///< eta    [-],    > 0, shear stiffness / normal stiffness
    double tensile_strength = 0.0;  ///< sigma_nt [Pa], > 0
    double cohesion = 0.0;          ///< tau    [Pa],   > 0
    double friction = 0.0;          ///< mu_c   [-],    >= 0
    double tensile_fracture_energy = 0.0;  ///< G_fn   [N/m],  >= sigma_nt^2 / (2 K_n)
    double shear_fracture_energy = 0.0;    ///< G_fs   [N/m],  >= tau^2 / (2 eta K_n)
    double dilation = 0.0;       ///< tan psi [-], >= 0 and <= friction: opening per plastic slip
    double dilation_slip = 0.0;  ///< plastic slip at which dilation ends [m], >= 0
};

/// Properties of a contact in the form that the law needs at every step.
struct LawParameters {
    double normal_stiffness = 0.0;  ///< K_n [Pa/m]
    double shear_stiffness = 0.0;   ///< eta K_n [Pa/m]
    double tensile_strength = 0.0;  ///< [Pa]
    double cohesion = 0.0;          ///< [Pa]
    double friction = 0.0;          ///< [-]
    double elastic_opening = 0.0;   ///< u_e = sigma_nt / K_n [m]
    double critical_opening = 0.0;  ///< u_c = 2 G_fn / sigma_nt [m]
    double critical_slip = 0.0;     ///< s_c = 2 G_fs / tau [m]
    double inverse_softening_length =
        0.0;  ///< 1 / (u_c - u_e) [1/m]; `brittle_limit` in the brittle limit
    double slip_compliance =
        0.0;  ///< 1 / (eta K_n - tau / s_c) [m/Pa]; `brittle_limit` in the limit
    double dilation_compliance = 0.0;  ///< tan psi / (eta K_n) [m/Pa]
    double dilation_limit = 0.0;       ///< eta K_n times the slip at which dilation ends [Pa]
};

/// Stand-in for infinity: any excess over the strength uses up all damage at once, and an
/// excess of exactly zero still gives zero.
constexpr double brittle_limit = 1e200;

/// Derive the law's parameters from a contact's properties.
/// @throws std::invalid_argument  if a value is not finite or out of range, or if a fracture energy
///         is below the elastic energy at the strength by more than 1e-12 of it
LawParameters make_law(const ContactMaterial& material);

/// Material whose strengths are multiplied by a factor, and fracture energies by its square: the curves of Fig. 3 grow in
/// both directions, so a brittle contact stays brittle.
ContactMaterial scaled_strength(const ContactMaterial& material, double factor);

/// Whether a joint has no strength: its points are cracked from the start.
bool is_cracked(const ContactMaterial& joint);

/// Law of a joint, whose strengths may be 0. Fracture energies of 0 are the elastic energies at the strengths.
/// Deviation D36: beside a strength above 0 one of 0 counts as a millionth of it.
/// @throws std::invalid_argument  as make_law(), for a strength below 0
LawParameters joint_law(const ContactMaterial& joint);

/// Material of the same stiffness and friction, with strengths that only an opening or a slip of one
/// metre would come to.
ContactMaterial unbreakable(const ContactMaterial& material);

/// State of a point, which is all that it needs to continue. All zero means bonded and unloaded.
struct PointState {
    double opening = 0.0;          ///< u [m], relative to the bonded state; compression < 0
    double max_opening = 0.0;      ///< largest law::gap() so far [m], >= 0
    double shear_traction = 0.0;   ///< along the tangent [Pa]
    double slip = 0.0;             ///< along the tangent, relative to the bonded state [m]
    double shear_damage = 0.0;     ///< D_s [-]: plastic slip / s_c, at most 1
    double damage_energy = 0.0;    ///< dissipated by damage [J/m^2]
    double friction_energy = 0.0;  ///< dissipated by friction [J/m^2]
};

namespace law {

/// Opening that plastic slip has made, s_p = s - tau / (eta K_n): tan psi min(|s_p|, dilation_slip) [m].
inline double dilated(const LawParameters& p, double slip, double shear_traction)
{
    const double plastic = std::fabs(p.shear_stiffness * slip - shear_traction);
    return p.dilation_compliance * std::min(plastic, p.dilation_limit);
}

/// Opening less what dilation has made of it [m]: what the normal traction follows.
inline double gap(const LawParameters& p, const PointState& s)
{
    return s.opening - dilated(p, s.slip, s.shear_traction);
}

/// D_n [-] of a point whose largest opening is `max_opening`.
inline double normal_damage(const LawParameters& p, double max_opening)
{
    return std::min(
        std::max((max_opening - p.elastic_opening) * p.inverse_softening_length, 0.0), 1.0);
}

/// D = min(D_n + D_s, 1) [-]; 1 = cracked.
inline double damage(const LawParameters& p, double max_opening, double shear_damage)
{
    return std::min(normal_damage(p, max_opening) + shear_damage, 1.0);
}

/// Slope of the secant to the largest opening [Pa/m].
inline double secant(const LawParameters& p, double max_opening, double damage)
{
    // below u_e the elastic slope governs an undamaged point; the guard keeps 0 / 0 away
    const double divisor = std::max(max_opening, 1e-9 * p.elastic_opening);
    return std::min(p.normal_stiffness, (1.0 - damage) * p.tensile_strength / divisor);
}

/// Normal traction [Pa], tension positive.
inline double normal_traction(
    const LawParameters& p, double opening, double max_opening, double damage)
{
    return opening * (opening > 0.0 ? secant(p, max_opening, damage) : p.normal_stiffness);
}

/// Energy [J/m^2] dissipated by opening monotonically to `max_opening` at constant shear damage:
/// the area under the envelope less what the secant still stores.
inline double opening_dissipation(const LawParameters& p, double max_opening, double shear_damage)
{
    const double strength = (1.0 - shear_damage) * p.tensile_strength;
    const double first = strength / p.normal_stiffness;  // the envelope turns flat here
    const double last =
        p.elastic_opening + (1.0 - shear_damage) * (p.critical_opening - p.elastic_opening);
    const double flat = std::min(std::max(max_opening, first), p.elastic_opening);
    const double soft = std::min(std::max(max_opening, p.elastic_opening), last);
    const double sigma = (1.0 - damage(p, max_opening, shear_damage)) * p.tensile_strength;
    const double on_plateau = 0.5 * strength * (flat - first);
    const double on_slope = 0.5 * strength * p.elastic_opening
        + 0.5 * (strength + sigma) * (soft - p.elastic_opening) - 0.5 * sigma * soft;
    return on_plateau + (max_opening > p.elastic_opening ? on_slope : 0.0);
}

/// Energy stored by a point [J/m^2].
inline double elastic_energy(const LawParameters& p, const PointState& s)
{
    const double d = damage(p, s.max_opening, s.shear_damage);
    const double opening = gap(p, s);
    return 0.5 * opening * normal_traction(p, opening, s.max_opening, d)
        + 0.5 * s.shear_traction * s.shear_traction / p.shear_stiffness;
}

}  // namespace law

/// Normal and shear traction of a point [Pa] and its damage before and after the step.
struct Traction {
    double normal;
    double shear;
    double damage_before;
    double damage;
};

namespace law {

/// dilated() of a point, or 0 where no law at hand dilates.
template <bool Dilating>
FLEXPM_INLINE double dilated_if(const LawParameters& p, double slip, double shear_traction)
{
    return Dilating ? dilated(p, slip, shear_traction) : 0.0;
}

}  // namespace law

/// Advance a point that stays on its current branch: no new damage, no slip. Returns false, and
/// changes nothing, if it would not.
///
/// @tparam Intact  true: the point has no damage, which need not be worked out
/// @tparam Dilating  false: the law does not dilate
template <bool Intact = false, bool Dilating = true>
FLEXPM_INLINE bool advance_elastic(const LawParameters& p, double opening_step, double slip_step,
    const PointState& s, PointState& next, Traction& traction)
{
    const double d = Intact ? 0.0 : law::damage(p, s.max_opening, s.shear_damage);
    const double apart = s.opening + opening_step;
    const double opening = apart - law::dilated_if<Dilating>(p, s.slip, s.shear_traction);
    const double largest = std::max(s.max_opening, opening);
    const double slope = Intact ? p.normal_stiffness : law::secant(p, s.max_opening, d);
    const double normal = opening * (opening > 0.0 ? slope : p.normal_stiffness);
    const double shear = s.shear_traction + p.shear_stiffness * slip_step;
    const double limit = std::max((1.0 - d) * p.cohesion - p.friction * normal, 0.0);
    // a new largest opening stays elastic below the strength that is left, hence below u_e
    const bool same_secant = (largest == s.max_opening)
        | (p.normal_stiffness * largest <= (1.0 - d) * p.tensile_strength);
    next = s;
    next.opening = apart;
    next.max_opening = largest;
    next.shear_traction = shear;
    next.slip = s.slip + slip_step;
    traction = { normal, shear, d, d };
    return same_secant & (std::fabs(shear) <= limit);
}

/// Energy [J/m^2] that goes from friction into the gap when dilation changes it at one damage.
inline double lifting_work(double gap_before, double normal_before, double gap, double normal)
{
    return 0.5 * (gap * normal - gap_before * normal_before);
}

/// Tractions [Pa] that friction leaves and energy [J/m^2] that it takes in a step.
struct Sliding {
    double shear;
    double normal;
    double loss;
};

/// Friction of a point that shear has used up (D_s = 1), which carries no tension and cannot be damaged
/// further. Together with advance_elastic() this is the whole step of such a point. `trial` is what
/// that has made of `before`, with the tractions that the point would have without friction.
template <bool Dilating = true>
FLEXPM_INLINE Sliding slide_used_up(
    const LawParameters& p, double normal, const PointState& before, const PointState& trial)
{
    const double size = std::fabs(trial.shear_traction);
    const double limit = std::max(-p.friction * normal, 0.0);
    const double shear = std::min(size, limit);
    const double slip = (size - shear) / p.shear_stiffness;
    const double along = std::copysign(1.0, trial.shear_traction) * before.shear_traction;
    const double held = std::copysign(shear, trial.shear_traction);
    const double loss = 0.5 * std::max(along + shear, 0.0) * slip;
    if (!Dilating) return { held, normal, loss };
    const double first = trial.opening - law::dilated(p, before.slip, before.shear_traction);
    const double opening = trial.opening - law::dilated(p, trial.slip, held);
    const double lifted = p.normal_stiffness * std::min(opening, 0.0);
    return { held, lifted, loss - lifting_work(first, normal, opening, lifted) };
}

/// Advance a point by an increment of opening and slip [m]: tensile damage, normal traction, shear
/// return with its damage in closed form, and the normal traction once more with the new damage and
/// dilation.
/// The function has no branches, so that eight points advance at once.
///
/// @tparam Dilating  false: the law does not dilate
template <bool Dilating = true>
FLEXPM_INLINE Traction advance_point(
    const LawParameters& p, double opening_step, double slip_step, PointState& s)
{
    const double before = law::damage(p, s.max_opening, s.shear_damage);
    const double apart = s.opening + opening_step;
    const double opening = apart - law::dilated_if<Dilating>(p, s.slip, s.shear_traction);
    const double largest = std::max(s.max_opening, opening);
    const double normal_part = law::normal_damage(p, largest);
    const double opened = std::min(normal_part + s.shear_damage, 1.0);
    const double first_normal = law::normal_traction(p, opening, largest, opened);

    const double trial = s.shear_traction + p.shear_stiffness * slip_step;
    const double size = std::fabs(trial);
    const double limit = (1.0 - opened) * p.cohesion - p.friction * first_normal;
    const double excess = std::max(size - std::max(limit, 0.0), 0.0);
    const double slip_left = (1.0 - opened) * p.critical_slip;
    const double softening = p.cohesion / p.critical_slip;
    const double damaging = std::min(excess * p.slip_compliance, slip_left);
    const double new_limit = std::max(limit - softening * damaging, 0.0);
    const double shear_size = excess > 0.0 ? std::min(size, new_limit) : size;
    const double slip = (size - shear_size) / p.shear_stiffness;
    // both tests: round-off in `slip`, and brittle shear under tension, which slips less than slip_left
    const bool used_up = (damaging >= slip_left) | (slip >= slip_left);
    const double shear_damage =
        excess > 0.0 ? (used_up ? 1.0 : s.shear_damage + slip / p.critical_slip) : s.shear_damage;
    const double after = std::min(normal_part + shear_damage, 1.0);
    const double normal = law::normal_traction(p, opening, largest, after);
    const double shear = std::copysign(shear_size, trial), slipped = s.slip + slip_step;
    const double lifted =
        Dilating && excess > 0.0 ? apart - law::dilated(p, slipped, shear) : opening;
    const double lifted_normal =
        Dilating ? law::normal_traction(p, lifted, largest, after) : normal;

    // normal: growth of the largest opening at the old shear damage, then the loss of secant slope
    const double opening_loss = law::opening_dissipation(p, largest, s.shear_damage)
        - law::opening_dissipation(p, s.max_opening, s.shear_damage);
    const double secant_loss = 0.5 * opening * (first_normal - normal);
    // shear: the trapezoidal work of the step less what it stores, never below zero (a reversal in
    // one step); what friction does not take is damage
    const double along = std::copysign(1.0, trial) * s.shear_traction;
    const double shear_loss = 0.5 * std::max(along + shear_size, 0.0) * slip;
    const double resisted = std::max(-p.friction * first_normal, 0.0) * slip;
    const double friction_loss = before >= 1.0 ? shear_loss : std::min(resisted, shear_loss);

    s.opening = apart;
    s.max_opening = largest;
    s.shear_traction = shear;
    s.slip = slipped;
    s.shear_damage = shear_damage;
    s.damage_energy += opening_loss + secant_loss + (shear_loss - friction_loss);
    s.friction_energy += Dilating
        ? friction_loss - lifting_work(opening, normal, lifted, lifted_normal)
        : friction_loss;
    return { lifted_normal, shear, before, after };
}

}  // namespace flexpm
