// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  A contact point led along a path of opening and slip, and random materials for it.
/// Opening and tension positive; [m], [Pa], [J/m^2].
#pragma once

#include <flexpm/kernel/core/random.hpp>
#include <flexpm/kernel/law/bilinear_step.hpp>

#include "support/specimens.hpp"

#include <cmath>

namespace law_path {

using flexpm::ContactMaterial;
using flexpm::LawParameters;
using flexpm::PointState;
using flexpm::Traction;

inline double elastic_opening(const ContactMaterial& m)
{
    return m.tensile_strength / m.normal_stiffness;
}
inline double critical_opening(const ContactMaterial& m)
{
    return 2.0 * m.tensile_fracture_energy / m.tensile_strength;
}
inline double shear_stiffness(const ContactMaterial& m)
{
    return m.shear_ratio * m.normal_stiffness;
}
inline double elastic_slip(const ContactMaterial& m) { return m.cohesion / shear_stiffness(m); }
inline double critical_slip(const ContactMaterial& m)
{
    return 2.0 * m.shear_fracture_energy / m.cohesion;
}

/// The material with both fracture energies at their least: the brittle limit.
inline ContactMaterial brittle(ContactMaterial m)
{
    m.tensile_fracture_energy = 0.5 * m.tensile_strength * elastic_opening(m);
    m.shear_fracture_energy = 0.5 * m.cohesion * elastic_slip(m);
    return m;
}

/// Strengths and stiffnesses over a decade, friction 0 to 1.5, critical displacements of up to 40
/// times the elastic ones; every fifth material brittle.
inline ContactMaterial random_material(flexpm::Random& random)
{
    const auto decade = [&] { return std::pow(10.0, random.next() - 0.5); };
    ContactMaterial m = specimens::granite_contact();
    m.normal_stiffness *= decade();
    m.shear_ratio = 0.1 + 0.9 * random.next();
    m.tensile_strength *= decade();
    m.cohesion *= decade();
    m.friction = 1.5 * random.next();
    m = brittle(m);
    if (random.next() < 0.2) return m;
    m.tensile_fracture_energy *= 1.05 + 39.0 * random.next();
    m.shear_fracture_energy *= 1.05 + 39.0 * random.next();
    return m;
}

/// A point, its last traction, and the work done on it by the trapezoidal rule.
struct Path {
    LawParameters law;
    PointState state {};
    Traction traction {};
    double work = 0.0;
    double slip = 0.0;

    explicit Path(const ContactMaterial& m) : law(flexpm::make_law(m)) { }

    void advance(double opening_step, double slip_step)
    {
        const Traction old = traction;
        traction = flexpm::advance_point(law, opening_step, slip_step, state);
        slip += slip_step;
        work += 0.5 * (old.normal + traction.normal) * opening_step
            + 0.5 * (old.shear + traction.shear) * slip_step;
    }
    void advance(double opening_step, double slip_step, int steps)
    {
        for (int i = 0; i < steps; ++i)
            advance(opening_step / steps, slip_step / steps);
    }
    void open_to(double opening, int steps = 1) { advance(opening - state.opening, 0.0, steps); }
    void slip_to(double total, int steps = 1) { advance(0.0, total - slip, steps); }

    double stored() const { return flexpm::law::elastic_energy(law, state); }
    double dissipated() const { return state.damage_energy + state.friction_energy; }
    bool cracked() const { return traction.damage >= 1.0; }
};

}  // namespace law_path
