// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/laboratory/servo.hpp>

#include <flexpm/kernel/core/require.hpp>

#include <algorithm>
#include <cmath>

namespace flexpm {

namespace {

/// Factor per unit of the difference of growths, and per unit of the error [-].
constexpr double of_growth = 8.0, of_error = 8.0;
/// Change of the slope in a crossing per unit of the error, over the growth of the set point [-].
constexpr double of_slope = 2.0;
/// Smallest factor over the largest: the motion of the loading is changed by a ratio, which needs
/// one.
constexpr double least = 1e-4;

void check(const ServoRule& rule)
{
    check_positive("growth of the measure along the elastic solution", rule.rate, "");
    check_positive("largest velocity factor", rule.fastest, "");
    check_positive("steps of a crossing", rule.crossing, "");
}

/// Within the limits of the rule and not 0. What is no number keeps the factor: the run has
/// diverged, which is seen elsewhere.
double limited(double wanted, double before, const ServoRule& rule)
{
    if (!std::isfinite(wanted)) return before;
    const double size = std::clamp(std::fabs(wanted), least * rule.fastest, rule.fastest);
    return std::copysign(size, wanted);
}

}  // namespace

Servo servo_after(const Servo& before, const ServoLook& seen, const ServoRule& rule)
{
    check(rule);
    Servo now = before;
    const double crossings = seen.steps / rule.crossing;
    now.measure = seen.measure;
    now.set_point += seen.growth * rule.rate * seen.steps;
    const double error = (now.set_point - seen.measure) / (rule.rate * rule.crossing);
    const double grown = (seen.measure - before.measure) / (rule.rate * seen.steps);
    const double given = seen.of_loading / rule.rate;
    // what the loading gives in the coming steps changes with its factor at once: it is solved for
    const double share = of_growth * given / before.factor;
    const double pull = of_growth * (seen.growth - (grown - given)) + of_error * error;
    const double wanted = (before.slope * seen.growth + pull) / (1.0 + std::max(share, 0.0));
    now.factor = limited(wanted, before.factor, rule);
    const double slope = before.slope + of_slope * crossings * error / seen.growth;
    const double steepest = rule.fastest / seen.growth;
    if (now.factor == wanted) now.slope = std::clamp(slope, -steepest, steepest);
    return now;
}

}  // namespace flexpm
