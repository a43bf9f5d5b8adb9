// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Bilinear softening of one local contact point, paper Sec. 2.5-2.6, Eqs. 22-27 and Fig. 3:
/// its parameters, its state and what follows from both. bilinear_step.hpp advances it. Opening and
/// tension are positive, slip is counted along the contact's tangent. SI units.
/// Deviation D1: Eqs. 26-27 print D; D = 1 means cracked, so strengths are multiplied by (1 - D).
/// Deviation D2: damage follows the largest opening and the plastic slip so far; no healing.
/// Deviation D3: unloading in tension goes along the secant.
/// Deviation D43: plastic slip opens a joint that dilates, and slip back closes it.
/// Deviation D109: the friction of a cracked point falls with its plastic slip since the crack.
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
    /// mu_r [-], >= dilation and <= friction, without effect if `slip_length` is 0
    double residual_friction = 0.0;
    /// plastic slip since the crack at which friction has fallen to mu_r [m]; 0: it does not fall
    double slip_length = 0.0;
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
    double residual_friction = 0.0;    ///< mu_r [-]
    double friction_fall = 0.0;        ///< (mu_c - mu_r) / slip length [1/m], 0: friction stays

    /// Calls visit(name, member) for all members in the order of their rows.
    template <class Self, class Visitor>
    FLEXPM_INLINE static constexpr void visit_members(Self& s, Visitor&& visit)
    {
        visit("normal_stiffness", s.normal_stiffness);
        visit("shear_stiffness", s.shear_stiffness);
        visit("tensile_strength", s.tensile_strength);
        visit("cohesion", s.cohesion);
        visit("friction", s.friction);
        visit("elastic_opening", s.elastic_opening);
        visit("critical_opening", s.critical_opening);
        visit("critical_slip", s.critical_slip);
        visit("inverse_softening_length", s.inverse_softening_length);
        visit("slip_compliance", s.slip_compliance);
        visit("dilation_compliance", s.dilation_compliance);
        visit("dilation_limit", s.dilation_limit);
        visit("residual_friction", s.residual_friction);
        visit("friction_fall", s.friction_fall);
    }
};

/// Stand-in for infinity: any excess over the strength uses up all damage at once, and an
/// excess of exactly zero still gives zero.
constexpr double brittle_limit = 1e200;

/// Derive the law's parameters from a contact's properties.
/// @throws std::invalid_argument  if a value is not finite or out of range, or if a fracture energy
///         is below the elastic energy at the strength by more than 1e-12 of it
LawParameters make_law(const ContactMaterial& material);

/// Material whose strengths are multiplied by a factor, and fracture energies by its square: the
/// curves of Fig. 3 grow in both directions, so a brittle contact stays brittle.
ContactMaterial scaled_strength(const ContactMaterial& material, double factor);

/// Whether a joint has no strength: its points are cracked from the start.
bool is_cracked(const ContactMaterial& joint);

/// Law of a joint, whose strengths may be 0. Fracture energies of 0 are the elastic energies at the
/// strengths.
/// Deviation D36: beside a strength above 0 one of 0 counts as a millionth of it.
/// @throws std::invalid_argument  as make_law(), for a strength below 0
LawParameters joint_law(const ContactMaterial& joint);

/// Material of the same stiffness and friction, with strengths that only an opening or a slip of
/// one metre would come to.
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

    /// Calls visit(name, member) for all members in the order of their rows.
    template <class Self, class Visitor>
    FLEXPM_INLINE static constexpr void visit_members(Self& s, Visitor&& visit)
    {
        visit("opening", s.opening);
        visit("max_opening", s.max_opening);
        visit("shear_traction", s.shear_traction);
        visit("slip", s.slip);
        visit("shear_damage", s.shear_damage);
        visit("damage_energy", s.damage_energy);
        visit("friction_energy", s.friction_energy);
    }
};

namespace law {

/// Opening that plastic slip has made: tan psi min(|s_p|, dilation_slip) [m].
/// @param plastic  eta K_n |s_p| [Pa], where s_p = s - tau / (eta K_n)
inline double dilated(const LawParameters& p, double plastic)
{
    return p.dilation_compliance * std::min(plastic, p.dilation_limit);
}

/// The same of a slip and a shear traction along one tangent.
inline double dilated(const LawParameters& p, double slip, double shear_traction)
{
    return dilated(p, std::fabs(p.shear_stiffness * slip - shear_traction));
}

/// Whether friction falls after a crack.
inline bool weakens(const LawParameters& p) { return p.friction_fall > 0.0; }

/// Friction of a point after a plastic slip since its crack [m], 0 of an intact point [-].
inline double friction_after(const LawParameters& p, double crack_slip)
{
    return std::max(p.friction - p.friction_fall * crack_slip, p.residual_friction);
}

/// Slip since the crack from which on the friction is the residual one [m].
inline double slip_to_residual(const LawParameters& p)
{
    return weakens(p) ? (p.friction - p.residual_friction) / p.friction_fall : 0.0;
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

}  // namespace flexpm
