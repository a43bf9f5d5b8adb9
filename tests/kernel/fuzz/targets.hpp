// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  What the fuzzers try, each from any bytes: the kernel refuses its input with an exception
/// of its own, or all that it makes of it holds. Anything else ends the process.
#pragma once

#include <cstddef>
#include <cstdint>

namespace fuzz {

/// Discs and an outline to cells.
void tessellate(const std::uint8_t* data, std::size_t size);

/// Lines of joints through cells.
void joints(const std::uint8_t* data, std::size_t size);

/// Cells and options to an assembly and its first steps.
void assemble(const std::uint8_t* data, std::size_t size);

/// A material and a path of opening and slip through the law of a point.
void law(const std::uint8_t* data, std::size_t size);

/// A saved state with changed members to check_state() and whatever uses a state.
void state(const std::uint8_t* data, std::size_t size);

}  // namespace fuzz
