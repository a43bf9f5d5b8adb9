// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The same bits on every instruction set that this machine has.
#include <flexpm/kernel/core/instruction_set.hpp>
#include <flexpm/kernel/measure/energy_balance.hpp>

#include "support/catch.hpp"

#include "support/sample_runs.hpp"

#include <cstring>
#include <stdexcept>

using flexpm::Assembly;
using flexpm::InstructionSet;

namespace {

/// Uses a set as long as it lives.
struct Using {
    InstructionSet before = flexpm::instruction_set();

    explicit Using(InstructionSet set) { flexpm::use_instruction_set(set); }
    ~Using() { flexpm::use_instruction_set(before); }
    Using(const Using&) = delete;
    Using& operator=(const Using&) = delete;
};

template <int Number> FLEXPM_INLINE int number() { return Number; }

/// What functions of a set sum up without changing the state.
struct Sums {
    flexpm::Energies energies;
    double unbalanced;

    explicit Sums(const Assembly& a) :
        energies(flexpm::energies(a)),
        unbalanced(flexpm::unbalanced_ratio(a))
    {
    }
    bool operator==(const Sums& other) const
    {
        return std::memcmp(this, &other, sizeof(Sums)) == 0;
    }
};

}  // namespace

#ifndef FLEXPM_ONE_COPY
TEST_CASE("The widest instruction set of the machine is in use until another is chosen")
{
    const auto sets = flexpm::available_instruction_sets();
    REQUIRE(sets.front() == InstructionSet::baseline);
    CHECK(flexpm::instruction_set() == sets.back());
    const auto function = [] { return flexpm::variant_of<number<1>, number<2>>(); };
    std::vector<decltype(function())> functions;
    for (InstructionSet set : sets) {
        const Using chosen(set);
        CHECK(flexpm::instruction_set() == set);
        CHECK(function()() == (set == InstructionSet::avx512 ? 2 : 1));
        CHECK(std::count(functions.begin(), functions.end(), function()) == 0);
        functions.push_back(function());
    }
    CHECK(flexpm::instruction_set() == sets.back());
}
#endif

TEST_CASE("An instruction set that the machine lacks is refused by its name")
{
    if (flexpm::available_instruction_sets().back() == InstructionSet::avx512) return;
    CHECK_THROWS_WITH(flexpm::use_instruction_set(InstructionSet::avx512),
        Catch::Contains("instruction set = avx512"));
}

TEST_CASE("All instruction sets give the bits of the plainest one")
{
    for (const sample_runs::Run& run : sample_runs::all()) {
        INFO(run.name);
        std::vector<Assembly> ends;
        std::vector<Sums> sums;
        for (InstructionSet set : flexpm::available_instruction_sets()) {
            const Using chosen(set);
            ends.push_back(run.end_state());
            sums.emplace_back(ends.back());
        }
        for (std::size_t i = 1; i < ends.size(); ++i) {
            CHECK(same_bits::difference(ends[i], ends[0]).empty());
            CHECK(sums[i] == sums[0]);
        }
    }
}

TEST_CASE("The runs that are compared crack, soften, slide and touch")
{
    int touches = 0;
    for (const sample_runs::Run& run : sample_runs::all()) {
        INFO(run.name);
        const Assembly a = run.end_state();
        const flexpm::Energies e = flexpm::energies(a);
        const flexpm::CrackCount cracks = flexpm::count_cracks(a);
        CAPTURE(cracks.tensile, cracks.shear, e.damage, e.friction, e.kinetic);
        CHECK(flexpm::find_bad_number(a).empty());
        CHECK(cracks.tensile + cracks.shear > 3);
        CHECK(cracks.tensile + cracks.shear < a.contacts.count * a.contacts.group.points);
        CHECK(e.damage > 0.0);
        CHECK(e.friction > 0.0);
        touches += static_cast<int>(
            std::count(a.contacts.bonded.begin(), a.contacts.bonded.end(), std::uint8_t { 0 }));
    }
    CHECK(touches > 0);
}
