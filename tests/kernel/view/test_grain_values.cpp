// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Values by which a window colours grains, in states with closed forms. SI units, tension
/// positive.
#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/plane_lanes/rigid_grain.hpp>
#include <flexpm/kernel/topology/erasure.hpp>
#include <flexpm/kernel/view/grain_values.hpp>

#include "support/catch.hpp"

#include "support/driven.hpp"

#include <cmath>

using namespace driven;
using flexpm::GrainValue;

namespace {

constexpr double size = 3e-3;  // of a grain [m]

Assembly grid(int columns, int rows, bool rigid = false)
{
    auto o = specimens::options();
    o.rigid = rigid;
    return specimens::assemble(specimens::grid(columns, rows, size), o);
}

/// Move a grain without turning it.
void shift(Assembly& a, int grain, Point way)
{
    for (int n = 0; n < a.grains.nodes_of(grain); ++n) {
        const int node = a.grains.node(grain, n);
        flexpm::set_vector(
            a.grains.displacement, node, vector_at(a.grains.displacement, node) + way);
    }
}

/// Open a bond so far that all its points have cracked.
void crack(Assembly& a, int contact)
{
    for (int p = 0; p < a.contacts.points_of(contact); ++p)
        a.contacts.state(contact, p, &flexpm::PointState::max_opening) =
            2.0 * a.contacts.law_of(contact).critical_opening;
}

}  // namespace

TEST_CASE("Each value has its name, title and unit", "[view]")
{
    CHECK(flexpm::grain_value("stress_yy") == GrainValue::stress_yy);
    CHECK(flexpm::grain_value("fragment") == GrainValue::fragment);
    CHECK_FALSE(flexpm::grain_value("shape"));
    CHECK(flexpm::scale_title(GrainValue::displacement) == "displacement [mm]");
    CHECK(flexpm::scale_factor(GrainValue::displacement) == 1e3);
    CHECK(flexpm::is_kind(GrainValue::mineral));
    CHECK(flexpm::is_kind(GrainValue::fragment));
    CHECK_FALSE(flexpm::is_kind(GrainValue::damage));
}

TEST_CASE("The stress of a grain under a uniform strain is that of Hooke's law", "[view]")
{
    Assembly a = grid(2, 2);
    const double e = 1e-9;
    for (int g = 0; g < a.grains.count; ++g) {
        for (int n = 0; n < a.grains.nodes_of(g); ++n) {
            const int node = a.grains.node(g, n);
            const Point p = vector_at(a.grains.reference, node);
            flexpm::set_vector(a.grains.displacement, node, { 2.0 * e * p.x, -e * p.y + e * p.x });
        }
    }
    const auto m = specimens::granite();
    const double c = m.young / (1.0 - m.poisson * m.poisson);
    const auto found = [&](GrainValue what) { return flexpm::grain_values(a, what); };
    for (int g = 0; g < a.grains.count; ++g) {
        CHECK(found(GrainValue::stress_xx)[g] == Approx(c * (2.0 - m.poisson) * e).epsilon(1e-6));
        CHECK(found(GrainValue::stress_yy)[g]
            == Approx(c * (-1.0 + 2.0 * m.poisson) * e).epsilon(1e-6));
        CHECK(found(GrainValue::stress_xy)[g]
            == Approx(m.young / (2.0 * (1.0 + m.poisson)) * e).epsilon(1e-6));
    }
}

TEST_CASE("The stress of a rigid grain is that of the tractions on its sides", "[view]")
{
    Assembly a = grid(3, 1, true);
    for (int g = 0; g < 3; ++g)
        flexpm::set_motion(a.grains, g, { 1e-9 * (g - 1), 0.0 }, 0.0, 1.0);
    for (std::size_t i = 0; i < a.grains.prescribed.size(); ++i)
        a.grains.prescribed[i] = 1;
    run(a, 1);
    const double traction = a.contacts.law_of(0).normal_stiffness * 1e-9;
    CHECK(flexpm::grain_values(a, GrainValue::stress_xx)[1] == Approx(traction).epsilon(1e-6));
    CHECK(flexpm::grain_values(a, GrainValue::stress_yy)[1] == Approx(0.0).margin(1e-6 * traction));
}

TEST_CASE("Displacement is that of the centre, minerals are those of the options", "[view]")
{
    Assembly a = grid(2, 1);
    shift(a, 1, { 3e-6, -4e-6 });
    CHECK(flexpm::grain_values(a, GrainValue::displacement)[1] == Approx(5e-6));
    CHECK(flexpm::grain_values(a, GrainValue::displacement)[0] == 0.0);
    CHECK(flexpm::grain_values(a, GrainValue::mineral) == std::vector<double> { 0.0, 0.0 });
    const auto size_now = flexpm::extent_of(a.grains);
    CHECK(size_now.high.x == Approx(2.0 * size + 3e-6));
    CHECK(size_now.low.y == Approx(-4e-6));
    const int node = a.grains.node(1, 0);
    CHECK(a.grains.point_at(node, 100.0).x == Approx(vector_at(a.grains.reference, node).x + 3e-4));
}

TEST_CASE("Damage is the mean over the points of a grain's bonds", "[view]")
{
    Assembly a = grid(3, 1);
    crack(a, 0);
    CHECK(flexpm::grain_values(a, GrainValue::damage) == std::vector<double> { 1.0, 0.5, 0.0 });
    flexpm::erase(a, { {}, { 0 } }, 1.0);
    CHECK(flexpm::grain_values(a, GrainValue::damage) == std::vector<double> { 0.0, 0.0, 0.0 });
}

TEST_CASE("Fragments hang together by what has not cracked, the largest is 0", "[view]")
{
    Assembly a = grid(4, 1);
    CHECK(flexpm::grain_values(a, GrainValue::fragment) == std::vector<double>(4, 0.0));
    crack(a, 0);
    CHECK(flexpm::grain_values(a, GrainValue::fragment)
        == std::vector<double> { 1.0, 0.0, 0.0, 0.0 });
    a.contacts.state(0, 1, &flexpm::PointState::max_opening) = 0.0;  // one point holds
    CHECK(flexpm::grain_values(a, GrainValue::fragment) == std::vector<double>(4, 0.0));
}

TEST_CASE("An erased grain has no value and is not in the extent", "[view]")
{
    Assembly a = grid(3, 1);
    flexpm::erase(a, { { 2 }, {} }, 1.0);
    for (auto what : { GrainValue::stress_xx, GrainValue::mineral, GrainValue::fragment })
        CHECK(std::isnan(flexpm::grain_values(a, what)[2]));
    CHECK(flexpm::grain_values(a, GrainValue::fragment)[0] == 0.0);
    CHECK(flexpm::extent_of(a.grains).high.x == Approx(2.0 * size));
}
