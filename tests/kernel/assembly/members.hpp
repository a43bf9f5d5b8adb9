// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Whether a saved part lists all its members, and comes back from them.
#pragma once

#include "support/catch.hpp"
#include "support/same_bits.hpp"

#include <cstddef>

namespace members {

inline std::size_t rounded_up(std::size_t size, std::size_t step)
{
    return (size + step - 1) / step * step;
}

/// Size of a struct of the members that a part lists, in their order [B].
template <class Part> std::size_t size_of_members(const Part& part)
{
    std::size_t size = 0;
    flexpm::visit_members(part, [&](const char*, const auto& member) {
        size = rounded_up(size, alignof(decltype(member))) + sizeof member;
    });
    return rounded_up(size, alignof(Part));
}

/// Whether a part lists its members in the order in which it declares them, each once.
template <class Part> bool in_order(const Part& part)
{
    const char* last = nullptr;
    bool ascending = true;
    flexpm::visit_members(part, [&](const char*, const auto& member) {
        const char* place = reinterpret_cast<const char*>(&member);
        ascending &= place > last;
        last = place;
    });
    return ascending;
}

/// A part whose members fill it lists all of them; a member left out leaves a hole.
template <class Part> void check_members(const Part& part)
{
    CHECK(in_order(part));
    CHECK(size_of_members(part) == sizeof(Part));
}

/// A part comes back from what it lists, and every number of it counts.
template <class Part> void check_round_trip(const Part& part)
{
    const same_bits::Bytes bytes = same_bits::bytes(part);
    CHECK(bytes.size() > 4);
    CHECK(same_bits::difference(part, same_bits::copy_of_members(part)).empty());
    CHECK_FALSE(same_bits::difference(part, Part()).empty());
}

}  // namespace members
