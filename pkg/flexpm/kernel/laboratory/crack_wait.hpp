// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Loading that waits for cracks, deviation D30: as fast as the elastic specimen allows,
/// nearly still while a crack runs. SI units.
///
/// The rate alters a strength only while cracks run: the load must not go on before they have
/// stopped. That one runs is seen by what damage and friction take, and damping from the waves that
/// it sends out, compared with what the loading would supply at its fastest in the same time. Of a
/// brittle crack the waves alone tell.
#pragma once

namespace flexpm {

struct CrackWaitRule {
    double fastest = 1.0;  ///< largest factor on the velocity [-]
    /// Smallest factor over the largest [-]. Nothing follows from a load that stands still: it
    /// would never go on.
    double slowest = 0.01;
    /// From this dissipated share on cracks count as running, before the peak and once the stress
    /// has fallen from it [-]. After the peak a specimen may take work for long without a crack
    /// that runs.
    double running_share = 0.002, share_after_peak = 0.01;
    double crossing = 1.0;  ///< steps in which a wave crosses the specimen
};

/// Part of its peak below which a stress has fallen from it [-].
constexpr double fallen_from_peak = 0.9;

/// What a controller sees of a test at two measured steps.
struct CrackWatch {
    double dissipated;    ///< by damage, friction and the damping of waves in between [J]
    double fastest_work;  ///< of the loading at its fastest velocity, at the present stress [J]
    double stress, peak;  ///< now and the largest so far, above the confinement [Pa]
    double steps;         ///< in between

    bool has_fallen() const { return stress < fallen_from_peak * peak; }
};

/// Work of an area under a stress that moves for a time [J]; `sweep` is the volume that it sweeps
/// in a unit of time [m^3/s].
constexpr double swept_work(double stress, double sweep, double time)
{
    return stress * sweep * time;
}

/// Velocity factor of the coming steps: `fastest` while the share of the work that is dissipated
/// lies below that of running cracks, and lower by the fourth power of their ratio above it. It at
/// most doubles while a wave crosses the specimen once, and at most halves in a quarter of that.
///
/// @param factor  of the last steps [-]
/// @throws std::invalid_argument  if a number of the rule is out of range
double factor_for_cracks(double factor, const CrackWatch& seen, const CrackWaitRule& rule);

/// Smallest velocity factor before points that will soften, over that of a loading that waits [-]:
/// a weak joint in strong rock asks for less.
constexpr double slowest_ahead = 0.01;

/// Velocity factor that `wanted` may have ahead of points that will soften: at most `most`, but
/// never so slow that nothing comes of it. It falls at once, as no wave follows from a change of
/// the loading's velocity.
double factor_ahead(double wanted, double most, const CrackWaitRule& rule);

}  // namespace flexpm
