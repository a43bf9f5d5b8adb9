// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Dilation of a joint: the gap that plastic slip makes, what it does to the normal
/// traction, and its work. Tension positive.
#include "support/catch.hpp"

#include "support/law_path.hpp"

#include <algorithm>
#include <stdexcept>

using namespace law_path;

namespace {

/// A cracked joint with mu = 0.6 and tan psi = 0.2 up to a slip of 0.1 mm.
ContactMaterial joint()
{
    ContactMaterial m;
    m.normal_stiffness = 2e12;
    m.shear_ratio = 0.5;
    m.friction = 0.6;
    m.dilation = 0.2;
    m.dilation_slip = 1e-4;
    return m;
}

struct JointPath : Path {
    ContactMaterial m;

    explicit JointPath(const ContactMaterial& material) :
        Path(specimens::granite_contact()),
        m(material)
    {
        law = flexpm::joint_law(m);
        state.shear_damage = 1.0;
    }
    double plastic_slip() const { return state.slip - state.shear_traction / law.shear_stiffness; }
};

constexpr double pressure = 5e6;  // [Pa]

}  // namespace

TEST_CASE("Slip between faces that cannot part presses them together")
{
    for (double sign : { 1.0, -1.0 }) {
        JointPath path(joint());
        path.open_to(-pressure / path.m.normal_stiffness);
        const double step = 1e-9;
        for (int i = 0; i < 80000; ++i)
            path.advance(0.0, sign * step);
        const double opened = path.m.dilation * std::fabs(path.plastic_slip());
        const double normal = pressure + path.m.normal_stiffness * opened;
        CHECK(-path.traction.normal == Approx(normal).epsilon(1e-12));
        // friction of a step is that of its begin
        const double late = path.m.friction * path.m.normal_stiffness * path.m.dilation * step;
        CHECK(sign * path.traction.shear == Approx(path.m.friction * normal).margin(late));
        CHECK(path.work == Approx(path.stored() + path.dissipated()).epsilon(1e-4));
    }
}

TEST_CASE("Under a constant pressure a joint opens by tan psi times its plastic slip, up to the "
          "stated slip")
{
    for (double sign : { 1.0, -1.0 }) {
        JointPath path(joint());
        path.open_to(-pressure / path.m.normal_stiffness);
        const double start = path.state.opening, step = sign * 5e-9;
        double lifted = 0.0, before = path.dissipated();
        for (int i = 0; i < 40000; ++i) {
            // what the last step has pressed together gives way
            const double give = (path.traction.normal + pressure) / path.m.normal_stiffness;
            path.advance(-give, step);
            lifted = path.state.opening - start;
            const double slipped = std::min(std::fabs(path.plastic_slip()), path.m.dilation_slip);
            REQUIRE(
                lifted == Approx(path.m.dilation * slipped).margin(1.01 * path.m.dilation * 5e-9));
        }
        CHECK(std::fabs(path.plastic_slip()) > 1.5 * path.m.dilation_slip);
        // shear does the work of friction; what lifts the pressure is no loss
        const double slid = std::fabs(path.plastic_slip());
        const double loss = pressure * (path.m.friction * slid - lifted);
        CHECK(path.dissipated() - before == Approx(loss).epsilon(1e-3));
        CHECK(path.state.damage_energy == 0.0);
    }
}

TEST_CASE("A joint that slips back closes, and has lost energy")
{
    JointPath path(joint());
    path.open_to(-pressure / path.m.normal_stiffness);
    double lost = 0.0;
    for (double way : { 6e-5, -1.2e-4, 6e-5 }) {
        const double start = path.plastic_slip();
        for (int i = 0; i < 20000; ++i) {
            path.advance(0.0, way / 20000);
            REQUIRE(path.dissipated() >= lost);
            lost = path.dissipated();
        }
        CHECK((path.plastic_slip() - start) * way > 0.0);
        const double opened = path.m.dilation * std::fabs(path.plastic_slip());
        CHECK(-path.traction.normal
            == Approx(pressure + path.m.normal_stiffness * opened).epsilon(1e-12));
    }
    CHECK(path.work == Approx(path.stored() + path.dissipated()).epsilon(1e-4));
}

TEST_CASE("Random paths of dilating contacts keep their energy, the better the finer their steps")
{
    flexpm::Random random(39);
    double error[3] = {}, total = 0.0;
    for (int i = 0; i < 60; ++i) {
        ContactMaterial m = random_material(random);
        m.dilation = m.friction * random.next();
        m.dilation_slip = 3.0 * critical_slip(m) * random.next();
        const double scale = m.tensile_fracture_energy + m.shear_fracture_energy;
        double opening[6], slip[6];
        for (int leg = 0; leg < 6; ++leg) {
            opening[leg] = elastic_opening(m) * (2.0 * random.next() - 1.5);
            slip[leg] = 2.0 * critical_slip(m) * (random.next() - 0.5);
        }
        for (int refinement = 0; refinement < 3; ++refinement) {
            Path path(m);
            for (int leg = 0; leg < 6; ++leg)
                path.advance(opening[leg], slip[leg], 2000 << refinement);
            const double miss = path.work - path.stored() - path.dissipated();
            error[refinement] += std::fabs(miss) / scale;
            if (refinement == 0) total += std::fabs(path.work) / scale;
        }
    }
    CAPTURE(error[0], error[1], error[2], total);
    CHECK(error[0] < 1e-3 * total);
    CHECK(error[1] < 0.6 * error[0]);
    CHECK(error[2] < 0.6 * error[1]);
}

TEST_CASE("Dilation beyond the friction is refused, and so is one below zero")
{
    ContactMaterial m = joint();
    m.dilation = 0.61;
    CHECK_THROWS_WITH(flexpm::joint_law(m),
        "dilation = 0.61, must be <= the friction 0.6; give a smaller dilation");
    m.dilation = -0.1;
    CHECK_THROWS_AS(flexpm::joint_law(m), std::invalid_argument);
    m = joint();
    m.dilation_slip = -1e-3;
    CHECK_THROWS_AS(flexpm::joint_law(m), std::invalid_argument);
}
