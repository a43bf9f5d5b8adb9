// SPDX-License-Identifier: GPL-3.0-or-later
#include <flexpm/kernel/view/colours.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace flexpm {

namespace {

/// Viridis (van der Walt and Smith, 2015) at even steps.
constexpr std::array<Colour, 9> viridis { {
    { 0.267, 0.005, 0.329 },
    { 0.279, 0.175, 0.483 },
    { 0.230, 0.322, 0.546 },
    { 0.173, 0.449, 0.558 },
    { 0.128, 0.567, 0.551 },
    { 0.158, 0.684, 0.502 },
    { 0.369, 0.789, 0.383 },
    { 0.678, 0.864, 0.190 },
    { 0.993, 0.906, 0.144 },
} };

/// Okabe and Ito (2008), without black.
constexpr std::array<Colour, 7> kinds { {
    { 0.337, 0.706, 0.914 },
    { 0.902, 0.624, 0.000 },
    { 0.000, 0.620, 0.451 },
    { 0.800, 0.475, 0.655 },
    { 0.941, 0.894, 0.259 },
    { 0.000, 0.447, 0.698 },
    { 0.835, 0.369, 0.000 },
} };

constexpr Colour pale { 0.925, 0.906, 0.863 }, grey { 0.5, 0.5, 0.5 };

double between(double from, double to, double share) { return from + share * (to - from); }

}  // namespace

ValueRange range_of(const std::vector<double>& values)
{
    ValueRange range;
    bool first = true;
    for (double value : values) {
        if (!std::isfinite(value)) continue;
        range.low = first ? value : std::min(range.low, value);
        range.high = first ? value : std::max(range.high, value);
        first = false;
    }
    return range;
}

Colour colour_of(double value, ValueRange range)
{
    if (std::isnan(value)) return grey;
    const double width = range.high - range.low;
    const double share = width > 0.0 ? std::clamp((value - range.low) / width, 0.0, 1.0) : 0.5;
    const double place = share * (viridis.size() - 1);
    const auto lower = std::min(static_cast<std::size_t>(place), viridis.size() - 2);
    const Colour from = viridis[lower], to = viridis[lower + 1];
    const double within = place - static_cast<double>(lower);
    return { between(from.red, to.red, within), between(from.green, to.green, within),
        between(from.blue, to.blue, within) };
}

Colour colour_of_kind(int number)
{
    return number <= 0 ? pale : kinds[static_cast<std::size_t>(number - 1) % kinds.size()];
}

}  // namespace flexpm
