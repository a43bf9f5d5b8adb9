// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Entry point of the kernel tests.
#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>
