// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Contacts of held grains led along prescribed motions: points, moment and rotation,
/// cracks, friction, paper Secs. 2.3-2.6. Tension positive.
#include "support/catch.hpp"

#include "support/driven.hpp"
#include "support/law_path.hpp"

using namespace driven;

namespace {

constexpr double size = 3e-3;  // side of the square grains [m]

/// Two square grains side by side, all nodes held: the normal is +x, the edge x = size.
Assembly pair(int points = 3, const flexpm::ContactMaterial& m = specimens::granite_contact())
{
    auto o = specimens::options(m);
    o.points = points;
    Assembly a = specimens::assemble(specimens::grid(2, 1, size), o);
    hold_all(a);
    return a;
}

/// Traction of a point opened for the first time [Pa].
double envelope(const flexpm::ContactMaterial& m, double opening)
{
    const double ue = law_path::elastic_opening(m), uc = law_path::critical_opening(m);
    if (opening <= ue) return m.normal_stiffness * opening;
    return m.tensile_strength * std::max(uc - opening, 0.0) / (uc - ue);
}

struct ContactPoint {
    double place, area;  ///< along the edge from its middle [m], [m^2]
};

std::vector<ContactPoint> lobatto(int points)
{
    const double area = size * specimens::thickness;
    if (points == 1) return { { 0.0, area } };
    if (points == 2) return { { -0.5 * size, 0.5 * area }, { 0.5 * size, 0.5 * area } };
    return { { -0.5 * size, area / 6.0 }, { 0.0, 4.0 * area / 6.0 }, { 0.5 * size, area / 6.0 } };
}

/// Both grains turn about the middle of the edge, against each other, and part: the opening grows
/// by `stretch` + `turn` * y per step, the normal stays.
void set_bending(Assembly& a, double stretch, double turn)
{
    for (int g = 0; g < 2; ++g) {
        const double sign = g == 0 ? -1.0 : 1.0;
        set_velocity(a, g, [&](Point p) {
            return Point { 0.5 * sign * (stretch + turn * (p.y - 0.5 * size)),
                -0.5 * sign * turn * (p.x - size) };
        });
    }
}

/// Moment of the contact about the middle of its edge, positive as its opening grows with y [N m].
double moment(const Assembly& a)
{
    return 0.5 * size * (contact_force(a, 0, 0, 1).x - contact_force(a, 0, 0, 0).x);
}

}  // namespace

TEST_CASE("Contact points lie at the Lobatto places and share the area of the edge")
{
    for (int points : { 1, 2, 3 }) {
        const Assembly a = pair(points);
        for (int p = 0; p < points; ++p) {
            const ContactPoint expected = lobatto(points)[p];
            CHECK(a.contacts.area(0, p) == Approx(expected.area).epsilon(1e-14));
            for (int side = 0; side < 2; ++side) {
                CHECK(a.contacts.weight(0, p, side)
                    == Approx(0.5 + expected.place / size).margin(1e-15));
            }
        }
    }
}

TEST_CASE("With the point on the centre line it lies where Eq. 7 puts it for d_v = 0")
{
    specimens::Specimen s = specimens::grid(2, 1, 1.0);
    s.discs[0] = { { 0.5, 0.5 }, 0.4 };
    s.discs[1] = { { 1.5, 0.8 }, 0.6 };
    auto o = specimens::options();
    o.points = 1;
    o.on_centre_line = true;
    const Assembly a = specimens::assemble(s, o);
    const double d = std::sqrt(1.09);
    const double from_a = 0.4 - 0.5 * (0.4 + 0.6 - d);
    CHECK(a.contacts.weights[0] == Approx(0.5 + from_a * 0.3 / d).epsilon(1e-14));
    CHECK(a.contacts.areas[0] == Approx(specimens::thickness).epsilon(1e-14));
    o.points = 3;
    CHECK_THROWS_AS(specimens::assemble(s, o), std::invalid_argument);
}

TEST_CASE("Moment and normal force follow the rotation through cracking, in closed form")
{
    const auto m = specimens::granite_contact();
    const double uc = law_path::critical_opening(m);
    const int steps = 400;
    for (int points : { 1, 2, 3 }) {
        for (double middle :
            { 0.0, 0.3, 1.0, -0.5 }) {  // opening of the middle over that of the end
            CAPTURE(points, middle);
            Assembly a = pair(points);
            const double end = 1.5 * uc / steps;  // opening of the end by the turn alone, per step
            set_bending(a, middle * end, end / (0.5 * size));
            const double scale = m.tensile_strength * size * specimens::thickness;
            for (int k = 1; k <= steps; ++k) {
                run(a, 1);
                double force = 0.0, torque = 0.0;
                for (const ContactPoint& p : lobatto(points)) {
                    const double u = k * end * (middle + p.place / (0.5 * size));
                    force += p.area * envelope(m, u);
                    torque += p.area * p.place * envelope(m, u);
                }
                REQUIRE(resultant(a, 0).x == Approx(force).epsilon(1e-10).margin(1e-10 * scale));
                REQUIRE(moment(a) == Approx(torque).epsilon(1e-10).margin(1e-10 * scale * size));
                REQUIRE(std::fabs(resultant(a, 0).y) < 1e-10 * scale);
            }
        }
    }
}

TEST_CASE("Three points give the exact bending stiffness of the edge, two three times as much")
{
    const auto m = specimens::granite_contact();
    const double exact = m.normal_stiffness * specimens::thickness * std::pow(size, 3) / 12.0;
    const double turn = 1e-8;
    for (int points : { 2, 3 }) {
        Assembly a = pair(points);
        set_bending(a, 0.0, turn);
        run(a, 1);
        CHECK(moment(a) == Approx((points == 3 ? 1.0 : 3.0) * exact * turn).epsilon(1e-10));
    }
}

TEST_CASE("A crack is recorded once, with its step, place and tensile mode")
{
    const auto m = specimens::granite_contact();
    const double uc = law_path::critical_opening(m);
    Assembly a = pair();
    const double end = uc / 99.5, middle = 0.4;
    set_bending(a, middle * end, end / (0.5 * size));
    run(a, 600);
    const auto points = lobatto(3);
    for (int p = 0; p < 3; ++p) {
        const double rate = end * (middle + points[p].place / (0.5 * size));
        const int index = a.contacts.point_index(0, p);
        if (rate < 0.0) {
            CHECK(a.contacts.crack_steps[index] == -1);
            CHECK(a.contacts.crack_modes[index] == flexpm::intact);
            CHECK(a.contacts.crack_energies[index] == 0.0);
            continue;
        }
        CHECK(a.contacts.crack_steps[index] == static_cast<int>(std::ceil(uc / rate)));
        CHECK(a.contacts.crack_modes[index] == flexpm::tensile_crack);
        CHECK(a.contacts.crack(0, p).position.x == Approx(size).epsilon(1e-12));
        CHECK(a.contacts.crack(0, p).position.y
            == Approx(0.5 * size + points[p].place).margin(1e-12 * size));
        CHECK(a.contacts.crack_energies[index]
            == Approx(points[p].area * m.tensile_fracture_energy).epsilon(1e-12));
    }
}

TEST_CASE("Sliding under pressure: peak, sign, shear cracks, then friction alone")
{
    const auto m = specimens::granite_contact();
    const double pressure = 40e6, area = size * specimens::thickness;
    const double k = law_path::shear_stiffness(m);
    const double strength = m.cohesion + m.friction * pressure;
    const int steps = 2000;
    const double step = 1.1 * (law_path::critical_slip(m) + strength / k) / steps;
    const double distance = size - pressure / m.normal_stiffness;
    Assembly a = pair();
    // the second grain goes round the first without turning: its chords are normal to the mean
    // normal of a step, so that the pressure stays
    double slip = 0.0, peak = 0.0;
    for (int i = 0; i <= steps; ++i) {
        const double angle = 2.0 * i * std::asin(0.5 * step / distance);
        const Point moved = { distance * std::cos(angle) - size, distance * std::sin(angle) };
        const Point now = vector_at(a.grains.displacement, a.grains.centre(1));
        set_velocity(a, 1, Point { moved.x - now.x, moved.y - now.y });
        run(a, 1);
        slip = i * step;
        const Point f = resultant(a, 0), n = a.contacts.normal(0);
        CHECK(n.x == Approx(std::cos(angle)).epsilon(1e-12));
        const double shear = f.y * n.x - f.x * n.y, normal = f.x * n.x + f.y * n.y;
        const double soft =
            (m.cohesion * (1.0 - slip / law_path::critical_slip(m)) + m.friction * pressure)
            / (1.0 - law_path::elastic_slip(m) / law_path::critical_slip(m));
        const double closed = std::min(k * slip, std::max(soft, m.friction * pressure));
        REQUIRE(normal == Approx(-pressure * area).epsilon(1e-9));
        // the second grain moves up: the first is dragged along
        REQUIRE(shear == Approx(closed * area).epsilon(1e-8).margin(1e-6));
        peak = std::max(peak, shear);
    }
    CHECK(peak == Approx(strength * area).epsilon(5e-3));
    const double first_cracked = (law_path::critical_slip(m) + m.friction * pressure / k) / step;
    for (int p = 0; p < 3; ++p) {
        const int index = a.contacts.point_index(0, p);
        CHECK(a.contacts.crack_modes[index] == flexpm::shear_crack);
        CHECK(a.contacts.crack_steps[index] == 1 + static_cast<int>(std::ceil(first_cracked)));
        CHECK(flexpm::damage_of(a.contacts, 0, p) == 1.0);
    }
}

TEST_CASE(
    "Under a constant pressure the friction of a crack falls with its plastic slip, in either "
    "sense")
{
    const bool rigid = GENERATE(false, true);
    auto m = specimens::granite_contact();
    m.residual_friction = 0.4 * m.friction;
    m.slip_length = 5e-5;
    const double pressure = 40e6, area = size * specimens::thickness;
    const double k = law_path::shear_stiffness(m), step = 2e-8;
    const double fall = (m.friction - m.residual_friction) / m.slip_length;
    // traction tau = mu(s) pressure where s is `slid` for tau = 0, and less by tau / k
    const auto sliding = [&](double slid) {
        const double tau = pressure * (m.friction - fall * slid) / (1.0 - fall * pressure / k);
        return std::max(tau, m.residual_friction * pressure);
    };
    auto o = specimens::options(m);
    o.rigid = rigid;
    Assembly a = specimens::assemble(specimens::grid(2, 1, size), o);
    hold_all(a);
    std::fill(a.grains.spin_prescribed.begin(), a.grains.spin_prescribed.end(), 1);
    const double distance = size - pressure / m.normal_stiffness;
    const auto shear_at = [&](int number) {  // after a slip of so many steps, as above
        const double angle = 2.0 * number * std::asin(0.5 * step / distance);
        const Point moved = { distance * std::cos(angle) - size, distance * std::sin(angle) };
        const Point now = vector_at(a.grains.displacement, a.grains.centre(1));
        set_velocity(a, 1, Point { moved.x - now.x, moved.y - now.y });
        run(a, 1);
        const Point f = resultant(a, 0), n = a.contacts.normal(0);
        return (f.y * n.x - f.x * n.y) / area;
    };
    double peak = 0.0, tau = 0.0;
    const double cracked = law_path::critical_slip(m), farthest = cracked + 0.5 * m.slip_length;
    int number = 0;
    for (; number * step < farthest; ++number) {
        tau = shear_at(number);
        peak = std::max(peak, tau);
        const double slid = number * step - cracked;
        if (slid > (m.friction * pressure) / k + step)
            REQUIRE(tau == Approx(sliding(slid)).epsilon(1e-3));
    }
    CHECK(peak == Approx(m.cohesion + m.friction * pressure).epsilon(5e-3));
    const double forth = (number - 1) * step, turned = tau;
    CHECK(tau == Approx((m.friction - 0.5 * fall * m.slip_length) * pressure).epsilon(0.02));
    for (int back = number - 2; forth - back * step < m.slip_length; --back) {
        tau = shear_at(back);
        const double sticks = turned - k * (forth - back * step);
        // plastic slip forth and back add up
        const double slid = forth - cracked - turned / k + (forth - back * step) - turned / k;
        REQUIRE(tau == Approx(std::max(sticks, -sliding(slid))).epsilon(1e-3).margin(1e3));
    }
    CHECK(tau == Approx(-m.residual_friction * pressure).epsilon(1e-9));
    CHECK(a.contacts.crack_slip(0, 1) > 1.4 * m.slip_length);
}
