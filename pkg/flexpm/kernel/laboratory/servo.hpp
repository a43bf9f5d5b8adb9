// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Servo of a loading, deviation D51: the velocity at which the ends must go, or go back,
/// for a measure of the specimen to follow its set point. SI units; the derivation stands in the
/// theory page.
///
/// A factor multiplies the slowest velocity of the ends, as in crack_wait.hpp. The measure's growth
/// in a step along the elastic solution at the factor 1, `rate`, is the unit of its growths, and
/// what it grows so while a wave crosses the specimen that of its errors.
#pragma once

namespace flexpm {

struct ServoRule {
    double rate = 1.0;  ///< growth of the measure in a step along the elastic solution, at factor 1
    double fastest = 1.0;   ///< largest factor of the ends, either way [-]
    double crossing = 1.0;  ///< steps in which a wave crosses the specimen
};

/// What a servo remembers from look to look.
struct Servo {
    double set_point = 0.0;
    double measure = 0.0;  ///< at the last look
    double factor = 1.0;   ///< of the ends; never 0 [-]
    double slope =
        1.0;  ///< factor of the ends over that of the set point along the path of the specimen [-]
};

/// What it sees at a look.
struct ServoLook {
    double measure = 0.0;
    double of_loading =
        0.0;  ///< growth of the measure in a step that the motion of the loading gives it now
    double growth = 1.0;  ///< of the set point: factor on `rate` [-]
    double steps = 1.0;   ///< since the last look
};

/// Growth of a measure in a step at the factor 1, of that at a factor.
constexpr double growth_at_unit_factor(double growth, double factor) { return growth / factor; }

/// The servo after a look, with the factor of the coming steps.
/// @throws std::invalid_argument  if a number of the rule is out of range
Servo servo_after(const Servo& before, const ServoLook& seen, const ServoRule& rule);

}  // namespace flexpm
