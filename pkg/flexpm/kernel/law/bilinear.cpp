// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Parameters of the bilinear law and their checks.
#include <flexpm/kernel/law/bilinear.hpp>

#include <flexpm/kernel/core/require.hpp>

namespace flexpm {

namespace {

// relative tolerance on "fracture energy = elastic energy", the brittle limit
constexpr double brittle_tolerance = 1e-12;

// relative: both may be tangents of the same angle
constexpr double angle_tolerance = 1e-12;

/// 1 / (critical - elastic), or `brittle_limit` where the two agree.
double inverse_difference(double critical, double elastic)
{
    return critical - elastic > brittle_tolerance * elastic ? 1.0 / (critical - elastic)
                                                            : brittle_limit;
}

/// Refuse a fracture energy below the elastic one, which leaves nothing to soften.
/// @param least  elastic energy at the strength [N/m]
void check_energy(const std::string& quantity, double value, double least)
{
    const double accepted = least * (1.0 - brittle_tolerance);
    if (value >= accepted) return;
    refuse(quantity, value, "N/m",
        "below the elastic energy at the strength; give at least " + number(accepted) + " N/m");
}

/// Refuse a friction that would rise with slip, or take less energy than dilation gives.
void check_residual(const ContactMaterial& m)
{
    check_not_negative("slip_length", m.slip_length, "m");
    check_not_negative("residual_friction", m.residual_friction, "");
    if (m.slip_length == 0.0) return;
    if (m.residual_friction > m.friction)
        refuse("residual_friction", m.residual_friction, "",
            "must be <= the friction " + number(m.friction) + "; give a smaller one");
    if (m.dilation > m.residual_friction * (1.0 + angle_tolerance))
        refuse("residual_friction", m.residual_friction, "",
            "must be >= the dilation " + number(m.dilation) + "; give a larger one");
}

/// Refuse a dilation that would give more energy than friction takes.
void check_dilation(const ContactMaterial& m)
{
    check_not_negative("dilation", m.dilation, "");
    check_not_negative("dilation_slip", m.dilation_slip, "m");
    if (m.dilation <= m.friction * (1.0 + angle_tolerance)) return;
    refuse("dilation", m.dilation, "",
        "must be <= the friction " + number(m.friction) + "; give a smaller dilation");
}

}  // namespace

LawParameters make_law(const ContactMaterial& m)
{
    check_positive("normal_stiffness", m.normal_stiffness, "Pa/m");
    check_positive("shear_ratio", m.shear_ratio, "");
    check_positive("tensile_strength", m.tensile_strength, "Pa");
    check_positive("cohesion", m.cohesion, "Pa");
    check_not_negative("friction", m.friction, "");
    check_positive("tensile_fracture_energy", m.tensile_fracture_energy, "N/m");
    check_positive("shear_fracture_energy", m.shear_fracture_energy, "N/m");
    check_dilation(m);
    check_residual(m);

    LawParameters p;
    p.normal_stiffness = m.normal_stiffness;
    p.shear_stiffness = m.shear_ratio * m.normal_stiffness;
    p.tensile_strength = m.tensile_strength;
    p.cohesion = m.cohesion;
    p.friction = m.friction;
    const double tensile_least = 0.5 * m.tensile_strength * m.tensile_strength / p.normal_stiffness;
    const double shear_least = 0.5 * m.cohesion * m.cohesion / p.shear_stiffness;
    check_energy("tensile_fracture_energy", m.tensile_fracture_energy, tensile_least);
    check_energy("shear_fracture_energy", m.shear_fracture_energy, shear_least);

    p.elastic_opening = m.tensile_strength / p.normal_stiffness;
    p.critical_opening =
        std::max(2.0 * m.tensile_fracture_energy / m.tensile_strength, p.elastic_opening);
    p.inverse_softening_length = inverse_difference(p.critical_opening, p.elastic_opening);
    const double elastic_slip = m.cohesion / p.shear_stiffness;
    p.critical_slip = std::max(2.0 * m.shear_fracture_energy / m.cohesion, elastic_slip);
    // eta K_n - tau / s_c = eta K_n (1 - s_e / s_c)
    const double inverse_length = inverse_difference(p.critical_slip, elastic_slip);
    p.slip_compliance = inverse_length < brittle_limit
        ? inverse_length * p.critical_slip / p.shear_stiffness
        : brittle_limit;
    p.dilation_compliance = m.dilation / p.shear_stiffness;
    p.dilation_limit = m.dilation_slip * p.shear_stiffness;
    p.residual_friction = m.slip_length > 0.0 ? m.residual_friction : m.friction;
    if (m.slip_length > 0.0)
        p.friction_fall =
            std::min((m.friction - m.residual_friction) / m.slip_length, brittle_limit);
    return p;
}

ContactMaterial scaled_strength(const ContactMaterial& material, double factor)
{
    check_positive("factor of the strength of a contact", factor, "");
    ContactMaterial m = material;
    m.tensile_strength *= factor;
    m.cohesion *= factor;
    m.tensile_fracture_energy *= factor * factor;
    m.shear_fracture_energy *= factor * factor;
    return m;
}

bool is_cracked(const ContactMaterial& joint)
{
    return joint.tensile_strength == 0.0 && joint.cohesion == 0.0;
}

LawParameters joint_law(const ContactMaterial& joint)
{
    constexpr double smallest_share = 1e-6;
    check_positive("normal_stiffness", joint.normal_stiffness, "Pa/m");
    check_positive("shear_ratio", joint.shear_ratio, "");
    check_not_negative("tensile_strength", joint.tensile_strength, "Pa");
    check_not_negative("cohesion", joint.cohesion, "Pa");
    ContactMaterial m = joint;
    // without any strength these have no effect: the law only needs a scale
    if (is_cracked(joint)) m.cohesion = m.tensile_strength = 1e-9 * m.normal_stiffness;
    m.tensile_strength = std::max(m.tensile_strength, smallest_share * m.cohesion);
    m.cohesion = std::max(m.cohesion, smallest_share * m.tensile_strength);
    const double tensile = 0.5 * m.tensile_strength * m.tensile_strength / m.normal_stiffness;
    const double shear = 0.5 * m.cohesion * m.cohesion / (m.shear_ratio * m.normal_stiffness);
    if (joint.tensile_strength == 0.0 || joint.tensile_fracture_energy == 0.0)
        m.tensile_fracture_energy = tensile;
    if (joint.cohesion == 0.0 || joint.shear_fracture_energy == 0.0)
        m.shear_fracture_energy = shear;
    return make_law(m);
}

ContactMaterial unbreakable(const ContactMaterial& material)
{
    constexpr double far = 1.0;  // [m]
    ContactMaterial m = material;
    m.tensile_strength = m.normal_stiffness * far;
    m.cohesion = m.shear_ratio * m.normal_stiffness * far;
    m.tensile_fracture_energy = m.tensile_strength * far;
    m.shear_fracture_energy = m.cohesion * far;
    return m;
}

}  // namespace flexpm
