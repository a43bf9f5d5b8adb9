// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Leaf functions compiled for several instruction sets, one of which is chosen at run time.
///
/// Without contraction of products and sums all sets give the same bits. Only leaf functions are
/// compiled more than once: whole sources compiled for a set would leave inline functions in it to
/// the linker, which may take them for all.
#pragma once

#include <vector>

namespace flexpm {

/// From narrow to wide registers: a machine that has one set has those before it.
enum class InstructionSet { baseline, avx2, avx512 };

const char* name_of(InstructionSet set);

/// Return the sets of this machine, the widest last.
std::vector<InstructionSet> available_instruction_sets();

namespace detail {

extern InstructionSet in_use;

}  // namespace detail

/// Return the set in use, at first the widest of this machine.
inline InstructionSet instruction_set() { return detail::in_use; }

/// Use a set from now on, in all assemblies of the process. Call it between steps only.
/// @throws std::invalid_argument  if this machine does not have it
void use_instruction_set(InstructionSet set);

/// One function, compiled for each set. `WideBody` takes its place where one register holds a row
/// of eight values. Both are FLEXPM_INLINE and become part of the functions here.
template <auto Body, auto WideBody = Body> struct Variants;

template <class Result, class... Arguments, Result (*Body)(Arguments...),
    Result (*WideBody)(Arguments...)>
struct Variants<Body, WideBody> {
    using Function = Result (*)(Arguments...);

    static Result baseline(Arguments... arguments) { return Body(arguments...); }
    __attribute__((target("avx2"))) static Result avx2(Arguments... arguments)
    {
        return Body(arguments...);
    }
    __attribute__((target("avx512f"))) static Result avx512(Arguments... arguments)
    {
        return WideBody(arguments...);
    }

#ifdef FLEXPM_ONE_COPY
    static constexpr Function of_set[] = { baseline, baseline, baseline };
#else
    static constexpr Function of_set[] = { baseline, avx2, avx512 };
#endif
};

/// The variant of a function for the set in use. Ask once for a pass over many blocks.
template <auto Body, auto WideBody = Body> typename Variants<Body, WideBody>::Function variant_of()
{
    return Variants<Body, WideBody>::of_set[static_cast<int>(instruction_set())];
}

}  // namespace flexpm
