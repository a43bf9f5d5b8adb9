// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Entry of libFuzzer, compiled for each target: FUZZ_TARGET is its name.
#include "fuzz/targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    fuzz::FUZZ_TARGET(data, size);
    return 0;
}
