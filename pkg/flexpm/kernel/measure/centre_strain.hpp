// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Mean strains of a rectangular specimen from the centres of its grains, for grains and for
/// the bonded spheres of a host program, paper Sec. 4.1. Extension positive. SI units.
/// Deviation D21: the axial strain is that between bands at a quarter and three quarters of the
/// height, so that the contacts with plates do not count.
#pragma once

#include <cstdint>
#include <vector>

namespace flexpm {

struct SpecimenStrain {
    double axial = 0.0;    ///< along y [-]
    double lateral = 0.0;  ///< along x, between the means of the left and right sides [-]
};

/// Part of a side of the specimen that belongs to a grain.
struct SideShare {
    int grain = 0;
    double length = 0.0;  ///< [m]
};

/// Where the strains of a specimen are measured, at the reference.
struct StrainGauge {
    double bottom = 0.0;                 ///< y of the lower end [m]
    double height = 0.0;                 ///< [m]
    double mean_diameter = 0.0;          ///< of the grains' discs [m]
    std::vector<SideShare> left, right;  ///< one for each edge of a grain on that side
    std::vector<std::uint8_t> erased;  ///< 1: a grain that is not there any more; if empty, all are
};

/// Mean place and displacement of grain centres along one axis.
class Station {
public:
    void add(double share, double place, double displacement);
    bool empty() const { return weight_ == 0.0; }
    friend double strain_between(const Station& first, const Station& second);
    friend double apart(const Station& first, const Station& second);

private:
    double weight_ = 0.0, place_ = 0.0, displacement_ = 0.0;
};

double strain_between(const Station& first, const Station& second);

/// From the mean place of the first to that of the second [m].
double apart(const Station& first, const Station& second);

/// Whether a centre at this height above the bottom is within a mean diameter of `station`, another
/// such height.
bool in_band(double above, double station, double mean_diameter);

/// @throws std::invalid_argument  if the station at `height` above the bottom is empty
void need_grains(const Station& station, double height);

/// @throws std::invalid_argument  if both stations are at one height, as of few large grains
void need_apart(const Station& low, const Station& high);

/// Strains of `grains` grains.
///
/// @param place         place(grain, component) of a centre at the reference [m]
/// @param displacement  displacement(grain, component) of a centre since then [m]
/// @throws std::invalid_argument  if a band has no grain, or both have the same
template <class Place, class Displacement>
SpecimenStrain centre_strain(
    const StrainGauge& gauge, int grains, Place place, Displacement displacement)
{
    const double low = 0.25 * gauge.height, high = 0.75 * gauge.height;
    Station at_low, at_high, at_left, at_right;
    for (int g = 0; g < grains; ++g) {
        if (!gauge.erased.empty() && gauge.erased[g]) continue;
        const double above = place(g, 1) - gauge.bottom;
        if (in_band(above, low, gauge.mean_diameter))
            at_low.add(1.0, place(g, 1), displacement(g, 1));
        if (in_band(above, high, gauge.mean_diameter))
            at_high.add(1.0, place(g, 1), displacement(g, 1));
    }
    need_grains(at_low, low);
    need_grains(at_high, high);
    need_apart(at_low, at_high);
    for (const SideShare& s : gauge.left)
        at_left.add(s.length, place(s.grain, 0), displacement(s.grain, 0));
    for (const SideShare& s : gauge.right)
        at_right.add(s.length, place(s.grain, 0), displacement(s.grain, 0));
    return { strain_between(at_low, at_high), strain_between(at_left, at_right) };
}

}  // namespace flexpm
