// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Servo of a loading: the ends' velocity for a measure to follow its set point, on a
/// specimen and on the model of a bar with one weak line. SI units.
#include "support/catch.hpp"

#include <flexpm/kernel/assembly/access.hpp>
#include <flexpm/kernel/laboratory/axial_measures.hpp>
#include <flexpm/kernel/laboratory/gauge.hpp>
#include <flexpm/kernel/laboratory/loading_motion.hpp>
#include <flexpm/kernel/laboratory/part_measures.hpp>
#include <flexpm/kernel/laboratory/servo.hpp>
#include <flexpm/kernel/parts/part_plates.hpp>
#include <flexpm/kernel/parts/plate_contact.hpp>
#include <flexpm/kernel/step/mass_scaling.hpp>
#include <flexpm/kernel/step/step.hpp>

#include "support/specimens.hpp"

#include <cmath>
#include <stdexcept>

using namespace flexpm;

namespace {

constexpr ServoRule rule = { 2.0, 16.0, 100.0 };

/// Bar with a weak line in the middle, of the theory page: the opening of the line and its rate,
/// the way of an end. Lengths are in those at the strength, times in wave crossings. A gauge lies
/// across the line.
struct Bar {
    double softening = 2.0;  ///< eta + 1: slope of the line's law over the stiffness of the bar
    double share = 0.1;      ///< length of the gauge over that of the bar
    double damping = 4.0;
    double way = 0.0, opening = 0.0, speed = 0.0;

    double reading() const { return share * stress() + opening; }
    double stress() const { return way - opening; }
    double strength() const { return std::max(1.0 - softening * opening, 0.0); }
    void advance(double velocity, double time)
    {
        way += velocity * time;
        const double force = stress() - strength();
        speed += time * (12.0 * force - damping * speed);
        if (opening <= 0.0 && speed < 0.0) speed = 0.0;
        opening += speed * time;
    }
};

/// What a servo to the gauge makes of the test.
struct Outcome {
    double
        error;  ///< largest error of the reading over the opening at which the line is broken [-]
    double slowest;  ///< least factor of the ends: below 0 where they go back [-]
};

Outcome controlled(Bar bar, double growth)
{
    constexpr double velocity = 0.01, time = 0.01;  // of the slowest ends; of a look
    const ServoRule r = { velocity * bar.share * time, 16.0, 100.0 };
    Servo servo;
    servo.factor = growth;
    Outcome found = { 0.0, growth };
    const double broken = 1.0 / bar.softening;
    while (servo.set_point < std::max(0.9 * broken, 1.5 * bar.share)) {
        for (int i = 0; i < 100; ++i)
            bar.advance(servo.factor * velocity, time / 100.0);
        const double given = bar.share * servo.factor * velocity * time;
        servo = servo_after(servo, { bar.reading(), given, growth, 1.0 }, r);
        const double error = std::fabs(bar.reading() - servo.set_point) / broken;
        found = { std::max(found.error, error), std::min(found.slowest, servo.factor) };
    }
    return found;
}

/// Grains between a plate that holds the bottom and one that presses on the top.
struct Squeezed {
    Assembly a;
    PartGeometry parts;
};

Squeezed squeezed(bool rigid)
{
    constexpr double width = 0.02, height = 0.04;
    auto options = specimens::options(specimens::strong_contact());
    options.rigid = rigid;
    Squeezed s;
    s.a = specimens::assemble(specimens::random_grains(width, height, 2.8e-3, 3), options);
    const int bottom = add_patch_plate(s.a, { { width / 2, 0.0 }, width, {} }, { 0.0, 1e6, false });
    const int top = add_patch_plate(s.a, { { width / 2, height }, width, {} }, {});
    scale_masses(s.a, 0.7);
    s.parts = { { top }, { bottom }, { 0.0, -1.0 }, width * specimens::thickness, height };
    set_velocity(s.a, top, { 0.0, -1e-8 });
    start_elastically(s.a, true, Held::by_parts);
    return s;
}

}  // namespace

TEST_CASE("A measure that grows along the elastic solution leaves the ends as they are")
{
    Servo servo;
    servo.factor = 3.0;
    double measure = 0.0;
    for (int look = 0; look < 200; ++look) {
        measure += 10.0 * rule.rate * servo.factor;
        servo = servo_after(servo, { measure, rule.rate * servo.factor, 3.0, 10.0 }, rule);
        CHECK(servo.factor == Approx(3.0));
        CHECK(servo.set_point == Approx(measure));
        CHECK(servo.slope == Approx(1.0));
    }
}

TEST_CASE("Ends go back while a bar with a weak line opens at its rate")
{
    const double softening = GENERATE(1.2, 2.0, 4.0, 8.0), share = GENERATE(0.05, 0.1);
    const Outcome found = controlled({ softening, share }, 1.6);
    CHECK(found.error < 0.01);
    CHECK(found.slowest < 0.0);
    CHECK(found.slowest > -16.0);
}

TEST_CASE("A gauge of more than the length that snaps back cannot be followed")
{
    // eta < 8/9 (1 - C) / C = 8 at C = 0.1
    CHECK(controlled({ 8.5, 0.1 }, 0.16).error < 0.05);
    CHECK(controlled({ 11.0, 0.1 }, 0.16).error > 0.05);
}

TEST_CASE("A servo keeps within the fastest velocity, either way, and never stands still")
{
    Servo servo;
    servo = servo_after(servo, { -1e6, 0.0, 1.0, 1.0 }, rule);
    CHECK(servo.factor == 16.0);
    CHECK(servo.slope == 1.0);  // it follows only what the ends can do
    servo = servo_after(servo, { 1e6, 0.0, 1.0, 1.0 }, rule);
    CHECK(servo.factor == -16.0);
    servo = { 0.0, 0.0, 1.0, 0.0 };
    servo = servo_after(servo, { 0.0, 2.0, 1e-12, 1.0 }, rule);
    CHECK(std::fabs(servo.factor) >= 1.6e-3);
    servo = servo_after({ 0.0, 0.0, 2.0, 1.0 }, { std::nan(""), 0.0, 1.0, 1.0 }, rule);
    CHECK(servo.factor == 2.0);
}

TEST_CASE("A rule of a servo without sense is refused")
{
    const double none = std::nan("");
    for (const ServoRule& bad : { ServoRule { 0.0, 16.0, 100.0 }, ServoRule { 2.0, none, 100.0 },
             ServoRule { 2.0, 16.0, -1.0 } })
        CHECK_THROWS_AS(servo_after({}, {}, bad), std::invalid_argument);
}

TEST_CASE("What a loading gives to a measure is what the measure then grows by")
{
    const bool rigid = GENERATE(false, true);
    Squeezed s = squeezed(rigid);
    const Assembly& a = s.a;
    const GaugePoints gauge = gauge_points(a.grains, { 0.004, 0.02 }, { 0.016, 0.02 });
    const Point across = { 1.0, 0.0 }, down = { 0.0, -1.0 };
    const Array<double> field = loading_field(a);
    const double rates[] = { gauge_opening(a.grains, field, gauge, across),
        lateral_strain(a, Sense::compression, field), plate_rate(a, s.parts.driven[0], down, field),
        part_load_rate(a, s.parts, field) };
    StepOptions options;
    options.measure = true;
    const int steps = 3000;
    for (int i = 0; i < steps; ++i)
        step(s.a, options);
    const auto& moved = a.grains.displacement;
    const double grown[] = { gauge_opening(a.grains, moved, gauge, across),
        lateral_strain(a, Sense::compression, moved), plate_way(a, s.parts.driven[0], down),
        part_load(a, s.parts) };
    for (int i = 0; i < 4; ++i)
        CHECK(grown[i] == Approx(steps * rates[i]).epsilon(0.03));
    CHECK(lateral_strain(a, Sense::tension, moved) == -grown[1]);
    s.a.plates[0].loaded = true;
    s.a.loading.plates.resize(1);
    s.a.loading.plates[0].velocity = { 3.0, 0.0 };
    CHECK(plate_rate(a, 0, across, a.grains.velocity) == 3.0);
}

TEST_CASE("A loading that goes back has the motion of the one that went on, turned round")
{
    Squeezed s = squeezed(false);
    const Array<double> on = loading_field(s.a);
    change_loading(s.a, -1.0);
    set_velocity(s.a, s.parts.driven[0], { 0.0, 1e-8 });
    REQUIRE(renew_loading(s.a, -1.0));
    const Array<double> back = loading_field(s.a);
    for_each_component(s.a.grains, [&](int i) { CHECK(back[i] == Approx(-on[i]).margin(1e-14)); });
}
