// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The bilinear law against its closed forms, paper Fig. 3 and Eqs. 22-27. Tension positive.
#include "support/catch.hpp"

#include "support/law_path.hpp"

#include <algorithm>
#include <limits>

using namespace law_path;

namespace {

const double confinements[] = { 0.0, 5e6, 50e6, 300e6 };  // [Pa]

/// A point under a normal pressure.
Path pressed(const ContactMaterial& m, double pressure)
{
    Path path(m);
    path.open_to(-pressure / m.normal_stiffness);
    return path;
}

}  // namespace

TEST_CASE("Opening a point to its critical opening dissipates G_fn, in any number of steps")
{
    flexpm::Random random(1);
    for (int i = 0; i < 200; ++i) {
        const ContactMaterial m = i == 0 ? specimens::granite_contact() : random_material(random);
        const int steps = 1 + static_cast<int>(300 * random.next());
        Path path(m);
        path.open_to(1.2 * critical_opening(m), steps);
        CHECK(path.state.damage_energy == Approx(m.tensile_fracture_energy).epsilon(1e-12));
        CHECK(path.state.friction_energy == 0.0);
        CHECK(path.stored() == 0.0);
        CHECK(path.traction.normal == 0.0);
        CHECK(path.cracked());
    }
}

TEST_CASE("The work of opening is G_fn")
{
    const ContactMaterial m = specimens::granite_contact();
    Path path(m);
    path.open_to(1.2 * critical_opening(m), 20000);
    CHECK(path.work == Approx(m.tensile_fracture_energy).epsilon(1e-6));
}

TEST_CASE("Tension follows the elastic line, peaks at the strength and softens on a line")
{
    flexpm::Random random(2);
    for (int i = 0; i < 500; ++i) {
        ContactMaterial m = random_material(random);
        m.tensile_fracture_energy *= 1.05;  // not brittle: the line has a slope
        const double ue = elastic_opening(m), uc = critical_opening(m);
        const double u = 1.3 * uc * random.next();
        const double closed = u < ue ? m.normal_stiffness * u
                                     : m.tensile_strength * std::max(uc - u, 0.0) / (uc - ue);
        Path path(m);
        path.open_to(u, 1 + i % 7);
        CHECK(path.traction.normal
            == Approx(closed).epsilon(1e-11).margin(1e-12 * m.tensile_strength));
        CHECK(path.traction.damage
            == Approx(std::min(std::max((u - ue) / (uc - ue), 0.0), 1.0))
                   .epsilon(1e-11)
                   .margin(1e-12));
    }
    const ContactMaterial m = specimens::granite_contact();
    Path path(m);
    double peak = 0.0;
    for (int i = 0; i < 4000; ++i) {
        path.advance(elastic_opening(m) / 1000.0, 0.0);
        peak = std::max(peak, path.traction.normal);
    }
    CHECK(peak == Approx(m.tensile_strength).epsilon(1e-9));
}

TEST_CASE("Slip under pressure dissipates G_fs in damage and mu sigma_n times the slip in friction")
{
    const ContactMaterial m = specimens::granite_contact();
    for (double pressure : confinements) {
        CAPTURE(pressure);
        Path path = pressed(m, pressure);
        const double before = path.work;
        const double end = 1.2 * critical_slip(m) + m.friction * pressure / shear_stiffness(m);
        path.slip_to(end, 2000);
        const double rubbed = end - m.friction * pressure / shear_stiffness(m);
        CHECK(path.cracked());
        // second order: the step that crosses the peak, and the one in which the point cracks
        CHECK(path.state.damage_energy == Approx(m.shear_fracture_energy).epsilon(1e-5));
        CHECK(path.state.friction_energy
            == Approx(m.friction * pressure * rubbed).epsilon(1e-10).margin(1e-9));
        CHECK(path.traction.shear == Approx(m.friction * pressure).epsilon(1e-12).margin(1e-6));
        const double stored = 0.5 * path.traction.shear * path.traction.shear / shear_stiffness(m);
        CHECK(path.work - before == Approx(path.dissipated() + stored).epsilon(1e-5));
    }
}

TEST_CASE("Shear peaks at c + mu sigma_n and softens on a line to mu sigma_n, either way")
{
    flexpm::Random random(3);
    for (int i = 0; i < 300; ++i) {
        ContactMaterial m = random_material(random);
        m.shear_fracture_energy *= 1.05;
        const double pressure = confinements[i % 4], sign = i % 2 ? -1.0 : 1.0;
        const double k = shear_stiffness(m), sc = critical_slip(m);
        const double strength = m.cohesion + m.friction * pressure, yield = strength / k;
        Path at_peak = pressed(m, pressure);
        at_peak.slip_to(sign * yield * (1.0 - 1e-12));
        CHECK(at_peak.traction.shear == Approx(sign * strength).epsilon(1e-11));
        CHECK(at_peak.traction.damage == 0.0);

        // at constant pressure tau = c (1 - p / sc) + mu sigma_n with the plastic slip p = s - tau
        // / k
        const double residual = m.friction * pressure, last = sc + residual / k;
        const double s = yield + (last - yield) * random.next();
        const double closed =
            (m.cohesion * (1.0 - s / sc) + residual) / (1.0 - m.cohesion / (sc * k));
        Path path = pressed(m, pressure);
        path.slip_to(sign * s, 1 + i % 9);
        CHECK(path.traction.shear == Approx(sign * closed).epsilon(1e-9).margin(1e-9 * strength));
        CHECK(path.traction.damage == Approx((s - closed / k) / sc).epsilon(1e-9).margin(1e-9));
    }
}

TEST_CASE("Unloading in tension goes along the secant and back, without loss")
{
    const ContactMaterial m = specimens::granite_contact();
    const double ue = elastic_opening(m), uc = critical_opening(m);
    for (double fraction : { 0.1, 0.5, 0.9 }) {
        Path path(m);
        const double reach = ue + fraction * (uc - ue);
        path.open_to(reach, 50);
        const double secant = (1.0 - fraction) * m.tensile_strength / reach;
        const double loss = path.state.damage_energy;
        for (double part : { 0.7, 0.2, 0.0, 0.4, 1.0 }) {
            path.open_to(part * reach, 3);
            CHECK(
                path.traction.normal == Approx(secant * part * reach).epsilon(1e-12).margin(1e-3));
            CHECK(path.state.damage_energy == loss);
            CHECK(path.traction.damage == Approx(fraction).epsilon(1e-12));
        }
        // the envelope goes on where it was left
        path.open_to(reach + 0.05 * (uc - ue));
        CHECK(path.traction.normal
            == Approx((0.95 - fraction) * m.tensile_strength).epsilon(1e-12).margin(1e-3));
    }
}

TEST_CASE("Compression keeps the whole normal stiffness after damage and after cracking")
{
    const ContactMaterial m = specimens::granite_contact();
    for (double reach : { 0.5, 1.5 }) {
        Path path(m);
        path.open_to(reach * critical_opening(m), 10);
        path.open_to(-3e-8, 10);
        CHECK(path.traction.normal == Approx(-3e-8 * m.normal_stiffness).epsilon(1e-12));
        path.open_to(0.0);
        CHECK(std::fabs(path.traction.normal) <= 1e-12 * m.tensile_strength);
    }
}

TEST_CASE("A cracked point rubs: mu times the present pressure, no cohesion, no tension")
{
    const ContactMaterial m = specimens::granite_contact();
    Path path(m);
    path.open_to(1.5 * critical_opening(m), 10);
    path.advance(0.0, 1e-6, 10);
    CHECK(path.traction.shear == 0.0);
    const double damage_loss = path.state.damage_energy;
    for (double pressure : { 1e6, 40e6, 10e6 }) {
        path.open_to(-pressure / m.normal_stiffness);
        path.advance(0.0, 2e-5, 1000);
        CHECK(path.traction.shear == Approx(m.friction * pressure).epsilon(1e-12));
        path.advance(0.0, -4e-5, 1000);
        CHECK(path.traction.shear == Approx(-m.friction * pressure).epsilon(1e-12));
    }
    CHECK(path.state.damage_energy == damage_loss);
    CHECK(path.state.friction_energy > 0.0);
    path.open_to(1e-7);
    CHECK(path.traction.normal == 0.0);
    path.advance(0.0, 1e-9);
    CHECK(path.traction.shear == 0.0);
}

TEST_CASE("Damage in shear lowers the tensile strength and the damage of both adds up")
{
    const ContactMaterial m = specimens::granite_contact();
    const double ue = elastic_opening(m), uc = critical_opening(m), sc = critical_slip(m);
    const double wanted = 0.4;  // plastic slip over critical slip
    Path path(m);
    path.slip_to(wanted * sc + (1.0 - wanted) * elastic_slip(m), 5);
    CHECK(path.traction.damage == Approx(wanted).epsilon(1e-9));
    path.slip_to(path.slip - path.traction.shear / shear_stiffness(m), 5);  // free of shear
    path.open_to(ue, 10);
    CHECK(path.traction.normal == Approx((1.0 - wanted) * m.tensile_strength).epsilon(1e-9));
    path.open_to(ue + 0.25 * (uc - ue), 10);
    CHECK(path.traction.damage == Approx(wanted + 0.25).epsilon(1e-9));
    CHECK(path.traction.normal == Approx((0.75 - wanted) * m.tensile_strength).epsilon(1e-9));
    path.open_to(ue + 0.61 * (uc - ue), 10);
    CHECK(path.cracked());
}

TEST_CASE("Parameters of the law that make no sense are refused")
{
    const auto refused = [](double ContactMaterial::*key, double value) {
        ContactMaterial m = specimens::granite_contact();
        m.*key = value;
        CHECK_THROWS_AS(flexpm::make_law(m), std::invalid_argument);
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (auto key : { &ContactMaterial::normal_stiffness, &ContactMaterial::shear_ratio,
             &ContactMaterial::tensile_strength, &ContactMaterial::cohesion,
             &ContactMaterial::tensile_fracture_energy, &ContactMaterial::shear_fracture_energy }) {
        for (double value : { 0.0, -1.0, nan, 1.0 / 0.0 })
            refused(key, value);
    }
    refused(&ContactMaterial::friction, -0.1);
    refused(&ContactMaterial::friction, nan);
    const ContactMaterial least = brittle(specimens::granite_contact());
    CHECK_NOTHROW(flexpm::make_law(least));
    refused(&ContactMaterial::tensile_fracture_energy, least.tensile_fracture_energy * (1 - 1e-9));
    refused(&ContactMaterial::shear_fracture_energy, least.shear_fracture_energy * (1 - 1e-9));
}

TEST_CASE("A factor on the strengths stretches the curve in both directions")
{
    const ContactMaterial m = specimens::granite_contact();
    const double factor = 1.7;
    const ContactMaterial strong = flexpm::scaled_strength(m, factor);
    const LawParameters one = make_law(m), other = make_law(strong);
    CHECK(other.tensile_strength == Approx(factor * one.tensile_strength));
    CHECK(other.cohesion == Approx(factor * one.cohesion));
    CHECK(other.elastic_opening == Approx(factor * one.elastic_opening));
    CHECK(other.critical_opening == Approx(factor * one.critical_opening));
    CHECK(other.critical_slip == Approx(factor * one.critical_slip));
    CHECK(other.normal_stiffness == one.normal_stiffness);
    CHECK_THROWS_AS(flexpm::scaled_strength(m, 0.0), std::invalid_argument);
}

TEST_CASE("A joint may lack a strength or an energy: what lacks breaks at once")
{
    ContactMaterial m = specimens::granite_contact();
    CHECK(flexpm::joint_law(m).critical_opening == make_law(m).critical_opening);
    CHECK(flexpm::joint_law(m).critical_slip == make_law(m).critical_slip);
    CHECK_FALSE(flexpm::is_cracked(m));

    m.tensile_fracture_energy = m.shear_fracture_energy = 0.0;
    const LawParameters brittle = flexpm::joint_law(m);
    CHECK(brittle.critical_opening == Approx(brittle.elastic_opening));
    CHECK(brittle.critical_slip == Approx(m.cohesion / (m.shear_ratio * m.normal_stiffness)));

    m.tensile_strength = 0.0;
    m.tensile_fracture_energy = 1.0;
    CHECK(flexpm::joint_law(m).tensile_strength == Approx(1e-6 * m.cohesion));
    CHECK_FALSE(flexpm::is_cracked(m));

    m.tensile_strength = 1e6;
    m.cohesion = 0.0;
    m.shear_fracture_energy = 1.0;
    CHECK(flexpm::joint_law(m).cohesion == Approx(1.0));

    m.tensile_strength = 0.0;
    CHECK(flexpm::is_cracked(m));
    CHECK(flexpm::joint_law(m).tensile_strength > 0.0);
    m.cohesion = -1.0;
    CHECK_THROWS_AS(flexpm::joint_law(m), std::invalid_argument);
}
