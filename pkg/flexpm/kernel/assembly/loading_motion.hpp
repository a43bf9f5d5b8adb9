// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The motion that a loading gives to grains and parts, deviation D30, and the one by which
/// a specimen comes down from its peak, deviation D55, as the state holds them. What writes and
/// uses them is laboratory/loading_motion.hpp and laboratory/steady_motion.hpp. SI units.
#pragma once

#include <flexpm/kernel/core/array.hpp>
#include <flexpm/kernel/core/vector.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace flexpm {

/// A motion of all grains.
struct GrainMotion {
    Array<double> velocity;  ///< of nodes, layout of Grains::displacement [m/s]
    Array<double> spin;      ///< of rigid grains, [slot] [rad/s]

    template <class Self, class Visitor> static void visit_members(Self& s, Visitor&& visit)
    {
        visit("velocity", s.velocity);
        visit("spin", s.spin);
    }
};

/// What the loading gives to a part.
struct PartMotion {
    Vector velocity;  ///< of a plate under a load, or a set that floats [m/s]
    Vector force;     ///< growth of that of a node set [N/s]
    Vector moment;    ///< the same of its moment [N m/s]

    template <class Self, class Visitor> static void visit_members(Self& s, Visitor&& visit)
    {
        visit("velocity_x", s.velocity.x);
        visit("velocity_y", s.velocity.y);
        visit("velocity_z", s.velocity.z);
        visit("force_x", s.force.x);
        visit("force_y", s.force.y);
        visit("force_z", s.force.z);
        visit("moment_x", s.moment.x);
        visit("moment_y", s.moment.y);
        visit("moment_z", s.moment.z);
    }
};

/// The elastic solution at the present velocity of the loading. Its velocities are parts of those
/// that grains and parts have. Damping does not act on them.
struct LoadingMotion {
    GrainMotion grains;
    /// As Assembly::plates and node_sets; parts that came after the loading had begun are not
    /// there, it gives them nothing.
    std::vector<PartMotion> plates, sets;

    PartMotion of_plate(std::size_t plate) const
    {
        return plate < plates.size() ? plates[plate] : PartMotion {};
    }
    PartMotion of_set(std::size_t set) const
    {
        return set < sets.size() ? sets[set] : PartMotion {};
    }

    template <class Self, class Visitor> static void visit_members(Self& s, Visitor&& visit)
    {
        visit("grains", s.grains);
        visit("plates", s.plates);
        visit("sets", s.sets);
    }
};

/// What the motion of the grains is followed by while a specimen comes down from its peak; all
/// lists are empty while it is not.
struct SteadyMotion {
    GrainMotion mean;            ///< since the last look; damping then leaves it alone instead
    Array<double> displacement;  ///< at the last look [m]
    Array<double> angle;         ///< of rigid grains at the last look, [slot] [rad]
    std::int64_t step = 0;       ///< of the last look

    bool is_followed() const { return !mean.velocity.empty(); }

    template <class Self, class Visitor> static void visit_members(Self& s, Visitor&& visit)
    {
        visit("mean", s.mean);
        visit("displacement", s.displacement);
        visit("angle", s.angle);
        visit("step", s.step);
    }
};

}  // namespace flexpm
