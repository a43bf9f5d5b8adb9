// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  The instruction set in use.
#include <flexpm/kernel/core/instruction_set.hpp>

#include <flexpm/kernel/core/require.hpp>

#include <string>

namespace flexpm {

namespace {

InstructionSet widest()
{
    if (__builtin_cpu_supports("avx512f")) return InstructionSet::avx512;
    if (__builtin_cpu_supports("avx2")) return InstructionSet::avx2;
    return InstructionSet::baseline;
}

}  // namespace

/// Zero and so `baseline` for constructors of other sources that run before: slower, never wrong.
InstructionSet detail::in_use = widest();

const char* name_of(InstructionSet set)
{
    return set == InstructionSet::avx512 ? "avx512"
        : set == InstructionSet::avx2    ? "avx2"
                                         : "baseline";
}

std::vector<InstructionSet> available_instruction_sets()
{
    std::vector<InstructionSet> sets;
    for (int set = 0; set <= static_cast<int>(widest()); ++set)
        sets.push_back(static_cast<InstructionSet>(set));
    return sets;
}

void use_instruction_set(InstructionSet set)
{
    if (set > widest()) {
        refuse("instruction set", name_of(set),
            std::string("this machine has at most ") + name_of(widest()) + "; use that");
    }
    detail::in_use = set;
}

}  // namespace flexpm
