// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  All inputs that the fuzzers start from, and all that they once failed with, on any
/// compiler.
#include "support/catch.hpp"

#include "fuzz/targets.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

namespace {

using Target = void (*)(const std::uint8_t*, std::size_t);

/// Run a target on each file of its folder; returns how many there are.
int run_all(const char* name, Target target)
{
    int files = 0;
    for (const auto& entry :
        std::filesystem::directory_iterator(std::filesystem::path(FUZZ_CORPUS) / name)) {
        std::ifstream file(entry.path(), std::ios::binary);
        const std::vector<char> text { std::istreambuf_iterator<char>(file), {} };
        INFO(entry.path());
        target(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
        ++files;
    }
    return files;
}

}  // namespace

TEST_CASE("What the fuzzers have found stays mended", "[fuzz]")
{
    CHECK(run_all("tessellate", fuzz::tessellate) > 0);
    CHECK(run_all("joints", fuzz::joints) > 0);
    CHECK(run_all("assemble", fuzz::assemble) > 0);
    CHECK(run_all("law", fuzz::law) > 0);
    CHECK(run_all("state", fuzz::state) > 0);
}
