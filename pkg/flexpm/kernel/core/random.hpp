// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Seeded random numbers that are the same on every platform.
#pragma once

#include <cstdint>
#include <random>

namespace flexpm {

/// Generator of random numbers from the standard's engine. Its distributions are not used, because
/// they differ between libraries.
class Random {
public:
    explicit Random(std::uint64_t seed) : engine(seed) { }
    /// Next number, uniform in [0, 1), of 53 random bits.
    double next() { return static_cast<double>(engine() >> 11) * 0x1p-53; }

private:
    std::mt19937_64 engine;
};

}  // namespace flexpm
