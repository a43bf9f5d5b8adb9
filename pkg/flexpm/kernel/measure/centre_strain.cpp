// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/measure/centre_strain.hpp>

#include <flexpm/kernel/core/require.hpp>

#include <cmath>

namespace flexpm {

void Station::add(double share, double place, double displacement)
{
    weight_ += share;
    place_ += share * place;
    displacement_ += share * displacement;
}

double strain_between(const Station& first, const Station& second)
{
    const double u = second.displacement_ / second.weight_ - first.displacement_ / first.weight_;
    return u / apart(first, second);
}

double apart(const Station& first, const Station& second)
{
    return second.place_ / second.weight_ - first.place_ / first.weight_;
}

bool in_band(double above, double station, double mean_diameter)
{
    // a little more, so that round-off does not choose
    return std::fabs(above - station) <= 1.001 * mean_diameter;
}

void need_grains(const Station& station, double height)
{
    if (!station.empty()) return;
    refuse("height of a strain gauge", height, "m", "has no grain near; use smaller grains");
}

void need_apart(const Station& low, const Station& high)
{
    const double height = apart(low, high);
    if (height > 0.0) return;
    refuse("height between strain gauges", height, "m",
        "must be > 0: both gauges are on the same grains; use smaller grains");
}

}  // namespace flexpm
