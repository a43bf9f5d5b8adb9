// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Catch2 2 or 3, whichever is installed, by the names of version 2.
#pragma once

#if __has_include(<catch2/catch_all.hpp>)

#include <catch2/catch_all.hpp>

using Catch::Approx;

namespace Catch {

inline auto Contains(const std::string& part) { return Matchers::ContainsSubstring(part); }

}  // namespace Catch

#else

#include <catch2/catch.hpp>

#endif
