// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference/point_law.hpp"

#include <algorithm>
#include <cmath>

namespace plain {

namespace {

using flexpm::LawParameters;

bool opens_brittle(const LawParameters& law)
{
    return law.inverse_softening_length >= flexpm::brittle_limit;
}
bool slides_brittle(const LawParameters& law)
{
    return law.slip_compliance >= flexpm::brittle_limit;
}

/// D_n = clamp((u_max - u_e) / (u_c - u_e), 0, 1).
double opening_damage(const LawParameters& law, double largest)
{
    if (largest <= law.elastic_opening) return 0.0;
    if (opens_brittle(law)) return 1.0;
    const double share =
        (largest - law.elastic_opening) / (law.critical_opening - law.elastic_opening);
    return std::min(share, 1.0);
}

/// Normal traction: u > 0: u min(K_n, (1 - D) sigma_t / u_max); u < 0: K_n u.
double normal_traction(const LawParameters& law, double opening, double largest, double damage)
{
    if (opening <= 0.0) return law.normal_stiffness * opening;
    const double strength = (1.0 - damage) * law.tensile_strength;
    return opening * std::min(law.normal_stiffness, strength / largest);
}

/// Area under the curve of traction over opening, from 0 to `largest`, at constant shear damage
/// [J/m^2].
double work_of_opening(const LawParameters& law, double largest, double shear_damage)
{
    const double strength = (1.0 - shear_damage) * law.tensile_strength;
    const double rise = strength / law.normal_stiffness;  // where the strength is reached
    if (largest <= rise) return 0.5 * law.normal_stiffness * largest * largest;
    double work = 0.5 * strength * rise;
    work += strength * (std::min(largest, law.elastic_opening) - rise);
    if (largest <= law.elastic_opening) return work;
    const double end =
        law.elastic_opening + (1.0 - shear_damage) * (law.critical_opening - law.elastic_opening);
    const double reached = std::min(largest, end);
    const double left =
        reached < end ? strength * (end - reached) / (end - law.elastic_opening) : 0.0;
    return work + 0.5 * (strength + left) * (reached - law.elastic_opening);
}

/// What of that work the secant to the origin does not give back [J/m^2].
double loss_of_opening(const LawParameters& law, double largest, double shear_damage)
{
    const double damage = std::min(opening_damage(law, largest) + shear_damage, 1.0);
    const double stored = 0.5 * largest * normal_traction(law, largest, largest, damage);
    return work_of_opening(law, largest, shear_damage) - stored;
}

/// The return of the shear traction to its limit.
struct ShearReturn {
    double traction;  ///< absolute value [Pa]
    double slip;      ///< plastic [m]
    double shear_damage;
    double doubt = 1.0;
};

/// Friction that is left: linear in the slip since the crack, then constant.
double friction_left(const LawParameters& law, double crack_slip)
{
    const double loss = law.friction - law.residual_friction;
    if (loss == 0.0) return law.friction;
    const double length = loss / law.friction_fall;
    if (crack_slip >= length) return law.residual_friction;
    return law.friction - loss * crack_slip / length;
}

/// The slip that brings the traction back solves |trial| - K_s slip = limit - c slip / s_c, on the
/// falling branch of the limit; it ends where friction alone is left or nothing at all.
ShearReturn return_shear(
    const LawParameters& law, double size, double limit, double opened, double before)
{
    const double held = std::max(limit, 0.0);
    const double excess = size - held;
    const double doubt = std::fabs(excess) / law.cohesion;
    if (excess <= 0.0) return { size, 0.0, before, slides_brittle(law) ? doubt : 1.0 };
    const double slip_left = (1.0 - opened) * law.critical_slip;
    const double softening = law.cohesion / law.critical_slip;
    double softened = slip_left;
    if (!slides_brittle(law)) {
        softened = std::min(excess / (law.shear_stiffness - softening), slip_left);
    }
    ShearReturn result {};
    result.traction = std::min(size, std::max(limit - softening * softened, 0.0));
    result.slip = (size - result.traction) / law.shear_stiffness;
    const bool used_up = softened >= slip_left || result.slip >= slip_left;
    result.shear_damage = used_up ? 1.0 : before + result.slip / law.critical_slip;
    result.doubt = 1.0;
    if (slides_brittle(law)) {
        result.doubt = before < 1.0 ? doubt : 1.0;
    } else if (slip_left > 0.0) {
        const double asked = excess / (law.shear_stiffness - softening);
        result.doubt = std::min(std::fabs(asked - slip_left), std::fabs(result.slip - slip_left))
            / law.critical_slip;
    }
    return result;
}

/// Opening by dilation, tan psi times the plastic slip up to its end [m].
double dilated(const LawParameters& law, double slip, double shear_traction)
{
    if (law.dilation_compliance == 0.0) return 0.0;
    const double tangent = law.dilation_compliance * law.shear_stiffness;
    const double plastic = std::fabs(slip - shear_traction / law.shear_stiffness);
    return tangent * std::min(plastic, law.dilation_limit / law.shear_stiffness);
}

/// Distance of a damage from 1, where a crack is recorded.
double doubt_of_crack(const LawParameters& law, double opened, double shear_damage)
{
    if (opens_brittle(law) || opened >= 1.0 || shear_damage >= 1.0) return 1.0;
    return std::fabs(opened + shear_damage - 1.0);
}

}  // namespace

PointTraction advance(
    const LawParameters& law, double opening_step, double slip_step, ContactPoint& point)
{
    const flexpm::PointState old = point.state;
    const double damage_before =
        std::min(opening_damage(law, old.max_opening) + old.shear_damage, 1.0);

    const double mu = friction_left(law, point.crack_slip);

    // normal, with the damage of the opening
    const double apart = old.opening + opening_step;
    const double opening = apart - dilated(law, old.slip, old.shear_traction);
    const double largest = std::max(old.max_opening, opening);
    const double by_opening = opening_damage(law, largest);
    const double opened = std::min(by_opening + old.shear_damage, 1.0);
    const double first_normal = normal_traction(law, opening, largest, opened);

    // shear, with the damage of the slip
    const double trial = old.shear_traction + law.shear_stiffness * slip_step;
    const double limit = (1.0 - opened) * law.cohesion - mu * first_normal;
    const ShearReturn shear = return_shear(law, std::fabs(trial), limit, opened, old.shear_damage);

    // normal once more
    const double damage = std::min(by_opening + shear.shear_damage, 1.0);
    const double normal = normal_traction(law, opening, largest, damage);

    // dilation by the slip of this step; what it stores in the normal spring comes from friction
    const double shear_after = trial < 0.0 ? -shear.traction : shear.traction;
    const double lifted = apart - dilated(law, old.slip + slip_step, shear_after);
    const double lifted_normal = normal_traction(law, lifted, largest, damage);
    const double lifting = 0.5 * lifted * lifted_normal - 0.5 * opening * normal;

    // losses: growth of the opening, then of the shear damage, which takes stiffness from the
    // secant; a slip does the work of the mean traction, of which friction takes its share and
    // damage the rest
    const double lost_by_opening = loss_of_opening(law, largest, old.shear_damage)
        - loss_of_opening(law, old.max_opening, old.shear_damage);
    const double lost_by_secant = 0.5 * opening * (first_normal - normal);
    const double along = trial < 0.0 ? -old.shear_traction : old.shear_traction;
    const double slip_work = 0.5 * std::max(along + shear.traction, 0.0) * shear.slip;
    const double rubbed = std::max(-mu * first_normal, 0.0) * shear.slip;
    const double friction = damage_before >= 1.0 ? slip_work : std::min(rubbed, slip_work);

    if (law.friction_fall > 0.0 && damage_before >= 1.0) point.crack_slip += shear.slip;
    point.state.opening = apart;
    point.state.max_opening = largest;
    point.state.shear_traction = shear_after;
    point.state.slip = old.slip + slip_step;
    point.state.shear_damage = shear.shear_damage;
    point.state.damage_energy =
        old.damage_energy + lost_by_opening + lost_by_secant + (slip_work - friction);
    point.state.friction_energy = old.friction_energy + friction - lifting;
    point.doubt = std::min(shear.doubt, doubt_of_crack(law, by_opening, shear.shear_damage));
    if (opens_brittle(law) && old.max_opening <= law.elastic_opening) {
        const double reached = std::fabs(largest - law.elastic_opening) / law.elastic_opening;
        point.doubt = std::min(point.doubt, reached);
    }
    return { lifted_normal, shear_after, lifted, damage_before < 1.0 && damage >= 1.0 };
}

}  // namespace plain
