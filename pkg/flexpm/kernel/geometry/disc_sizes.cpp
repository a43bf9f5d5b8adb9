// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Number and radii of the discs of a specimen, paper Sec. 3.1.
#include <flexpm/kernel/geometry/disc_sizes.hpp>

#include <flexpm/kernel/core/format.hpp>

#include <cmath>
#include <stdexcept>

namespace flexpm {
namespace {

constexpr double pi = 3.14159265358979323846;

void check_diameters(double d_min, double d_max)
{
    if (!(std::isfinite(d_min) && d_min > 0.0))
        throw std::invalid_argument("disc radii: smallest diameter = " + number(d_min)
            + " m, must be finite and > 0; correct it");
    if (!(std::isfinite(d_max) && d_max >= d_min))
        throw std::invalid_argument("disc radii: largest diameter = " + number(d_max)
            + " m, must be finite and >= the smallest, " + number(d_min)
            + " m; swap or correct them");
}

}  // namespace

int disc_count(double area, double d_min, double d_max, double porosity)
{
    check_diameters(d_min, d_max);
    if (!(std::isfinite(area) && area > 0.0))
        throw std::invalid_argument("disc_count: area = " + number(area)
            + " m^2, must be finite and > 0; correct the dimensions");
    if (!(porosity >= 0.0 && porosity < 1.0))
        throw std::invalid_argument("disc_count: porosity = " + number(porosity)
            + ", must be >= 0 and < 1; the usual value is 0.1");
    const double mean_radius = 0.25 * (d_min + d_max);
    const double count = std::round(area * (1.0 - porosity) / (pi * mean_radius * mean_radius));
    if (!(count >= 1.0 && count < 1e8))
        throw std::invalid_argument("disc_count: discs = " + number(count)
            + ", must be >= 1 and < 1e8; change diameters or dimensions");
    return static_cast<int>(count);
}

std::vector<double> disc_radii(int count, double d_min, double d_max, std::uint64_t seed)
{
    check_diameters(d_min, d_max);
    if (count < 1)
        throw std::invalid_argument("disc_radii: count = " + std::to_string(count)
            + ", must be >= 1; ask for at least one disc");
    Random random(seed);
    std::vector<double> radii(count);
    for (double& r : radii)
        r = 0.5 * (d_min + (d_max - d_min) * random.next());
    return radii;
}

}  // namespace flexpm
