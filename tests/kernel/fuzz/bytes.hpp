// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Numbers from the bytes of a fuzzer; past their end all are zero.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace fuzz {

class Bytes {
public:
    Bytes(const std::uint8_t* from, std::size_t count) : next(from), left(count) { }

    bool empty() const { return left == 0; }

    template <class Number> Number raw()
    {
        Number value = 0;
        const std::size_t size = left < sizeof value ? left : sizeof value;
        if (size != 0) std::memcpy(&value, next, size);
        next += size;
        left -= size;
        return value;
    }

    int byte() { return raw<std::uint8_t>(); }
    bool flag() { return byte() % 2 != 0; }
    /// A whole number from `first` to `last`; `first` where there is none.
    int whole(int first, int last)
    {
        const int drawn = raw<std::uint16_t>();
        return last > first ? first + drawn % (last - first + 1) : first;
    }
    /// A number from 0 to 1 in steps of 1 / 65535.
    double share() { return raw<std::uint16_t>() / 65535.0; }
    /// A number of the size of `usual`, from 1e-12 to 1e12 of it.
    double near(double usual) { return usual * std::pow(10.0, 24.0 * share() - 12.0); }

    /// `usual`, any number at all, or one that programs stumble over.
    double wild(double usual)
    {
        constexpr double limit = std::numeric_limits<double>::infinity();
        constexpr double special[] = { 0.0, -0.0, limit, -limit, 5e-324, 1e308, -1.0, 1.0 };
        const int kind = byte();
        if (kind < 192) return usual;
        if (kind < 208) return special[kind % 8];
        if (kind < 232) return near(usual);
        return raw<double>();
    }

private:
    const std::uint8_t* next;
    std::size_t left;
};

}  // namespace fuzz
