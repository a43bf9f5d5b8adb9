// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The saved state of what moves steadily while a specimen comes down from its peak, deviation D55. SI units.
#pragma once

#include <flexpm/kernel/assembly/layout.hpp>

#include <cstdint>

namespace flexpm {

/// What the motion of the grains is followed by; all lists are empty while it is not. As it is, Grains::loading_velocity and
/// loading_spin hold the mean motion since the last look.
struct SteadyMotion {
    Array<double>
        loading_velocity;  ///< that the loading alone gives, layout of Grains::displacement [m/s]
    Array<double> loading_spin;  ///< the same of rigid grains, [slot] [rad/s]
    Array<double> displacement;  ///< at the last look [m]
    Array<double> angle;         ///< of rigid grains at the last look, [slot] [rad]
    std::int64_t step = 0;       ///< of the last look

    bool is_followed() const { return !loading_velocity.empty(); }

    template <class Self, class Visitor> static void visit_members(Self& s, Visitor&& visit)
    {
        visit("loading_velocity", s.loading_velocity);
        visit("loading_spin", s.loading_spin);
        visit("displacement", s.displacement);
        visit("angle", s.angle);
        visit("step", s.step);
    }
};

}  // namespace flexpm
