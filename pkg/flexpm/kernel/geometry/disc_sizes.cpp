// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Diameters drawn one after the other from a uniform distribution.
#include <flexpm/kernel/geometry/disc_sizes.hpp>

#include <flexpm/kernel/core/random.hpp>
#include <flexpm/kernel/core/require.hpp>
#include <flexpm/kernel/core/vector.hpp>

#include <cmath>

namespace flexpm {
namespace {

void check_diameters(double d_min, double d_max)
{
    if (!(std::isfinite(d_min) && d_min > 0.0)) {
        refuse("disc radii: smallest diameter", d_min, "m", "must be finite and > 0; correct it");
    }
    if (!(std::isfinite(d_max) && d_max >= d_min)) {
        refuse("disc radii: largest diameter", d_max, "m",
            "must be finite and >= the smallest, " + number(d_min) + " m; swap or correct them");
    }
}

}  // namespace

int disc_count(double area, double d_min, double d_max, double porosity)
{
    check_diameters(d_min, d_max);
    if (!(std::isfinite(area) && area > 0.0)) {
        refuse("disc_count: area", area, "m^2", "must be finite and > 0; correct the dimensions");
    }
    if (!(porosity >= 0.0 && porosity < 1.0)) {
        refuse(
            "disc_count: porosity", porosity, "", "must be >= 0 and < 1; the usual value is 0.1");
    }
    const double mean_radius = 0.25 * (d_min + d_max);
    const double count = std::round(area * (1.0 - porosity) / (pi * mean_radius * mean_radius));
    if (!(count >= 1.0 && count < 1e8)) {
        refuse("disc_count: discs", count, "",
            "must be >= 1 and < 1e8; change diameters or dimensions, which are in metres");
    }
    return static_cast<int>(count);
}

std::vector<double> disc_radii(int count, double d_min, double d_max, std::uint64_t seed)
{
    check_diameters(d_min, d_max);
    if (count < 1) refuse("disc_radii: count", count, "", "must be >= 1; give at least one disc");
    Random random(seed);
    std::vector<double> radii(count);
    for (double& r : radii)
        r = 0.5 * (d_min + (d_max - d_min) * random.next());
    return radii;
}

}  // namespace flexpm
