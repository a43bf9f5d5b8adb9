// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Entry point of the kernel tests; version 3 of Catch2 has its own.
#define CATCH_CONFIG_MAIN
#include "support/catch.hpp"
