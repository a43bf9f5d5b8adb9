// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The mean volume of spheres whose diameters are uniform.
#include <flexpm/kernel/space/sphere_sizes.hpp>

#include <flexpm/kernel/core/require.hpp>

namespace flexpm {

int sphere_count(double volume, double d_min, double d_max, double porosity)
{
    check_positive("sphere_count: smallest diameter", d_min, "m");
    check_positive("sphere_count: volume", volume, "m^3");
    if (!(std::isfinite(d_max) && d_max >= d_min)) {
        refuse("sphere_count: largest diameter", d_max, "m",
            "must be finite and >= the smallest, " + number(d_min) + " m; swap or correct them");
    }
    if (!(porosity >= 0.0 && porosity < 1.0)) {
        refuse(
            "sphere_count: porosity", porosity, "", "must be >= 0 and < 1; the usual value is 0.1");
    }
    const double mean_cube = 0.25 * (d_min + d_max) * (d_min * d_min + d_max * d_max);
    const double count = std::round(volume * (1.0 - porosity) / (pi / 6.0 * mean_cube));
    if (!(count >= 1.0 && count < 1e8)) {
        refuse("sphere_count: spheres", count, "",
            "must be >= 1 and < 1e8; change diameters or dimensions, which are in metres");
    }
    return static_cast<int>(count);
}

}  // namespace flexpm
