// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Colours of values, for a window.
#pragma once

#include <vector>

namespace flexpm {

/// Red, green and blue, 0 to 1.
struct Colour {
    double red = 0.0;
    double green = 0.0;
    double blue = 0.0;
};

/// Smallest and largest value.
struct ValueRange {
    double low = 0.0;
    double high = 0.0;
};

/// Range of all finite values; 0 to 0 without any.
ValueRange range_of(const std::vector<double>& values);

/// Colour of a value: viridis from the low end to the high one; what lies beyond has the colour of
/// the end. Grey for nan.
Colour colour_of(double value, ValueRange range);

/// Colour of a kind, by its number: pale for 0, then one of seven that stay apart for colour-blind
/// eyes.
Colour colour_of_kind(int number);

}  // namespace flexpm
