// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/catch.hpp"

#include <flexpm/kernel/core/array.hpp>

#include <cstdint>

using namespace flexpm;

TEST_CASE("Arrays begin on a cache line, large ones on a large page", "[core]")
{
    constexpr std::size_t page = AlignedAllocator<double>::large_page;
    for (const std::size_t size : { std::size_t(1), page / 8, 2 * page / 8, 5 * page / 8 + 3 }) {
        Array<double> values(size, 1.0);
        values.push_back(2.0);
        const auto address = reinterpret_cast<std::uintptr_t>(values.data());
        CHECK(address % (values.capacity() * 8 < 2 * page ? 64 : page) == 0);
        CHECK((values.front() == 1.0 && values[size] == 2.0));
    }
}
