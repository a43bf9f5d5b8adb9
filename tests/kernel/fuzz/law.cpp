// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/core/vector.hpp>
#include <flexpm/kernel/law/bilinear_step.hpp>

#include "fuzz/bytes.hpp"
#include "fuzz/holds.hpp"
#include "fuzz/targets.hpp"

#include <cmath>
#include <cstring>
#include <stdexcept>

namespace fuzz {

namespace {

using namespace flexpm;

/// Properties of a rock, each at times far away from it.
ContactMaterial draw_material(Bytes& bytes)
{
    ContactMaterial m;
    m.normal_stiffness = bytes.wild(1.8e14);
    m.shear_ratio = bytes.wild(0.28);
    m.tensile_strength = bytes.wild(8.5e6);
    m.cohesion = bytes.wild(29.75e6);
    m.friction = bytes.wild(0.4);
    m.tensile_fracture_energy = bytes.wild(20.0);
    m.shear_fracture_energy = bytes.wild(800.0);
    if (bytes.flag()) {
        m.dilation = bytes.wild(0.1);
        m.dilation_slip = bytes.wild(1e-5);
    }
    if (bytes.flag()) {
        m.residual_friction = bytes.wild(0.2);
        m.slip_length = bytes.wild(1e-4);
    }
    if (!bytes.flag()) return m;
    m.tensile_fracture_energy = 0.5 * m.tensile_strength * m.tensile_strength / m.normal_stiffness;
    m.shear_fracture_energy = 0.5 * m.cohesion * m.cohesion / (m.shear_ratio * m.normal_stiffness);
    return m;
}

/// Ways as large as a law of rock knows them: beyond, numbers overflow or lose their digits.
bool is_usual(const LawParameters& p)
{
    for (double way : { p.elastic_opening, p.critical_opening, p.critical_slip,
             p.cohesion / p.shear_stiffness }) {
        if (!(way > 1e-20 && way < 1e6)) return false;
    }
    for (double stiffness : { p.normal_stiffness, p.shear_stiffness }) {
        if (!(stiffness > 1e-30 && stiffness < 1e30)) return false;
    }
    if (p.dilation_compliance > 0.0) return false;  // friction may give back what lifts
    return p.friction == 0.0 || (p.friction > 1e-30 && p.friction < 1e6);
}

void check_step(const LawParameters& p, const PointState& old, const PointState& s, Traction t)
{
    const double slack = 1e-9;
    require(std::isfinite(t.normal) && std::isfinite(t.shear), "finite tractions");
    require(t.damage >= t.damage_before && t.damage <= 1.0, "damage grows up to 1");
    require(s.shear_damage >= old.shear_damage && s.max_opening >= old.max_opening, "no healing");
    require(t.normal
            <= (1.0 - t.damage) * p.tensile_strength * (1.0 + slack) + slack * p.tensile_strength,
        "tension below the strength");
    const double limit = std::fmax((1.0 - t.damage) * p.cohesion - p.friction * t.normal, 0.0);
    require(std::fabs(t.shear)
            <= limit * (1.0 + slack) + slack * p.cohesion + slack * p.friction * p.tensile_strength,
        "shear within its limit");
    require(s.friction_energy >= old.friction_energy, "friction takes energy");
}

/// An elastic step is the same on the short way.
void check_short_way(const LawParameters& p, const PointState& old, const PointState& s, Point way)
{
    PointState quick = old;
    Traction traction {};
    if (!advance_elastic(p, way.x, way.y, old, quick, traction)) return;
    require(quick.opening == s.opening && quick.max_opening == s.max_opening
            && quick.shear_traction == s.shear_traction && quick.shear_damage == s.shear_damage,
        "the short way of an elastic step");
}

}  // namespace

void law(const std::uint8_t* data, std::size_t size)
{
    Bytes bytes(data, size);
    LawParameters p;
    try {
        p = make_law(draw_material(bytes));
    } catch (const std::invalid_argument&) {
        return;
    }
    PointState s;
    const bool usual = is_usual(p);
    while (!bytes.empty()) {
        const double signs[] = { -1.0, 0.0, 1.0 };
        Point way { bytes.near(p.elastic_opening) * signs[bytes.byte() % 3],
            bytes.near(p.cohesion / p.shear_stiffness) * signs[bytes.byte() % 3] };
        const PointState old = s;
        const Traction t = advance_point(p, way.x, way.y, s);
        const bool far = std::fabs(s.opening) > 1e6 || std::fabs(s.slip) > 1e6;
        if (!usual || far) continue;
        check_step(p, old, s, t);
        check_short_way(p, old, s, way);
    }
}

}  // namespace fuzz
